// SPDX-License-Identifier: MIT
#include <glint/geometry/surface.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_geometry_surface {

using glint::SurfaceOf;

TEMPLATE_TEST_CASE("surface: without its own, the shading normal is the geometric one", "[geometry][surface]", float,
                   double) {
  const SurfaceOf<TestType> s{.normal = {1, 0, 0}};
  CHECK(s.shading_normal == glint::Vec3<TestType>{1, 0, 0});
}

TEST_CASE("surface: a cast keeps every member", "[geometry][surface]") {
  const SurfaceOf<double> s{.position = {1, 2, 3},
                            .position_error = {0.5, 0.25, 0.125},
                            .normal = {0, 1, 0},
                            .shading_normal = {1, 0, 0},
                            .tangent = {0, 0, 2},
                            .bitangent = {0, 3, 0},
                            .uv = {0.25, 0.75},
                            .footprint = {{1, 0, 0}, {0, 0, 0.5}}};
  CHECK(glint::surface_cast<double>(glint::surface_cast<float>(s)) == s);  // all are floats
}

}  // namespace test_geometry_surface
