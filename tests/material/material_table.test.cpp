// SPDX-License-Identifier: MIT
#include <glint/material/material_table.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/core/one_of.hpp>

namespace test_material_material_table {

using Any = glint::OneOf<glint::Lambertian, glint::Mirror>;

TEST_CASE("material table: each primitive has the material its index names", "[material][table]") {
  const glint::MaterialTable<Any> table{{glint::Mirror{}, glint::Lambertian{{0.25F}}}, {1, 0, 1}};
  CHECK(table.bsdf({}, 0).get_if<glint::Lambertian>()->reflectance == glint::Rgb{0.25F});
  CHECK(table.bsdf({}, 1).is_specular());
  CHECK_FALSE(table.bsdf({}, 2).is_specular());
}

}  // namespace test_material_material_table
