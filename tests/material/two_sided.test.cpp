// SPDX-License-Identifier: MIT
#include <glint/material/two_sided.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/material/textured.hpp>
#include <glint/texture/constant.hpp>

namespace test_material_two_sided {

TEST_CASE("two-sided material: the back looks like the front", "[material][two_sided]") {
  using Plain = glint::Textured<glint::Lambertian, glint::ConstantTexture>;
  const glint::TwoSidedMaterial material{Plain{{glint::Rgb{0.5F}}}};
  STATIC_REQUIRE(glint::Material<decltype(material)>);
  const auto bsdf = material.bsdf(glint::Surface{});
  const glint::Vec3<float> up{0, 0, 1};
  CHECK(bsdf.evaluate(up, up) == bsdf.evaluate(-up, -up));
  CHECK(bsdf.evaluate(up, up).r > 0);
  CHECK(bsdf.evaluate(up, -up) == glint::Rgb{0});
}

}  // namespace test_material_two_sided
