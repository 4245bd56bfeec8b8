// SPDX-License-Identifier: MIT
#include <glint/light/triangle_sampler.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/light/area.hpp>
#include <glint/testing/chi_square.hpp>

namespace test_light_triangle_sampler {

using glint::Triangle;
using glint::TriangleSampler;
using glint::Vec2;
using glint::Vec3;

static_assert(glint::AreaSampleable<TriangleSampler>);

namespace {

/// The unit square as three triangles, one of a half and two of a quarter; and one without area.
TriangleSampler unit_square() {
  const Vec3<float> a{0, 0, 0};
  const Vec3<float> b{1, 0, 0};
  const Vec3<float> c{1, 1, 0};
  const Vec3<float> d{0, 1, 0};
  const Vec3<float> middle{0.5F, 0.5F, 0};
  return TriangleSampler({{a, b, c}, {a, a, c}, {a, middle, d}, {middle, c, d}});
}

}  // namespace

TEST_CASE("triangle sampler: its area is that of its triangles", "[light][triangle_sampler]") {
  CHECK(area(unit_square()) == Approx(1).epsilon(1e-6));
  CHECK(area(TriangleSampler{}) == 0);
}

TEST_CASE("triangle sampler: points are uniform over all triangles", "[light][triangle_sampler]") {
  const TriangleSampler square = unit_square();
  const auto result = glint::testing::chi_square_square(
      [&](const Vec2<float>& uv) -> std::optional<Vec2<float>> {
        const auto sample = sample_area(square, uv);
        CHECK(sample.pdf == Approx(1).epsilon(1e-6));
        return Vec2<float>(sample.surface.position);
      },
      [](const Vec2<float>&) { return 1.0F; }, {.samples = 50'000, .significance = 1e-4});
  INFO(result.message);
  CHECK(result.passed);
}

}  // namespace test_light_triangle_sampler
