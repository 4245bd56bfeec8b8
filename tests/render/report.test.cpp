// SPDX-License-Identifier: MIT
#include <glint/render/report.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_render_report {

TEST_CASE("render report: sums keep that one part was not complete", "[render][report]") {
  glint::RenderReport sum{.samples = 1, .rays = 2, .dropped = 3, .seconds = 0.5};
  sum += {.samples = 10, .rays = 20, .dropped = 30, .seconds = 0.25, .complete = false};
  CHECK(sum == glint::RenderReport{11, 22, 33, 0.75, false});
}

}  // namespace test_render_report
