// SPDX-License-Identifier: MIT
#include <glint/material/concepts.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/material/material_table.hpp>

namespace test_material_concepts {

using glint::Lambertian;

TEST_CASE("material: a BSDF is the material that is alike everywhere", "[material][concepts]") {
  STATIC_REQUIRE(glint::Material<Lambertian>);
  STATIC_REQUIRE_FALSE(glint::Material<int>);
  STATIC_REQUIRE(std::is_same_v<glint::BsdfOf<glint::MaterialTable<Lambertian>>, Lambertian>);
  CHECK(bsdf_at(Lambertian{{0.3F}}, glint::Surface{}, 7) == Lambertian{{0.3F}});
}

}  // namespace test_material_concepts
