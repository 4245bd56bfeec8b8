// SPDX-License-Identifier: MIT
#include <glint/render/options.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_render_options {

TEST_CASE("render options: by default nobody watches and nobody stops", "[render][options]") {
  const glint::RenderOptions options;
  CHECK_FALSE(options.progress);
  CHECK_FALSE(options.stop.stop_possible());
  CHECK(options.samples > 0);
}

}  // namespace test_render_options
