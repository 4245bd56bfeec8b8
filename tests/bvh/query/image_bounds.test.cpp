// SPDX-License-Identifier: MIT
#include <glint/bvh/query/image_bounds.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <limits>
#include <type_traits>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/transform.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_image_bounds {

namespace {

using glint::Aabb;
using glint::Affine;
using glint::Vec3;

template <typename T>
Affine<T> turned(T angle) {
  return Affine<T>::translate({T(3), T(-1), T(2)}) * Affine<T>::rotate({T(1), T(2), T(3)}, angle) *
         Affine<T>::scale({T(0.5), T(-2), T(1)});
}

template <typename T>
Aabb<T> box_of_vertices(const glint::MeshBuffers<T>& mesh, const Affine<T>& affine) {
  Aabb<T> box;
  for (const std::uint32_t i : mesh.indices) extend(box, affine.point(mesh.positions[i]));
  return box;
}

template <typename T>
Aabb<T> grown(const Aabb<T>& box, T by) {
  return {box.lower - by, box.upper + by};
}

/// Coordinates are below 16, and a dozen roundings of them are made.
template <typename T>
constexpr T rounding = T(200) * std::numeric_limits<T>::epsilon();

/// What images that look at one level, two and so on leave out of the exact one, or a deeper one adds to one above.
template <typename T, typename LayoutName>
struct Found {
  int too_small = 0;
  int farther = 0;

  explicit Found(const LayoutName& layout) {
    const auto soup = glint::testing::triangle_soup<T>(500, 3);
    const glint::Bvh bvh(view(soup), glint::BinnedSah{}, layout);
    for (int i = 0; i < 12; ++i) {
      const Affine<T> affine = turned(T(0.5) * T(i));
      const Aabb<T> exact = box_of_vertices(soup, affine);
      Aabb<T> above = transform(affine, bvh.bounds());
      for (int levels = 1; levels < 6; ++levels) {
        const Aabb<T> image = image_bounds(bvh.nodes(), bvh.bounds(), affine, levels);
        too_small += contains(grown(image, rounding<T>), exact) ? 0 : 1;
        farther += contains(grown(above, rounding<T>), image) ? 0 : 1;
        above = image;
      }
    }
  }
};

}  // namespace

TEMPLATE_TEST_CASE("image bounds: hold all primitives, and are the closer the more levels they look at", "[bvh][query]",
                   float, double) {
  using T = TestType;
  const Found<T, glint::WideLayout<8>> wide(glint::wide<8>);
  CHECK(wide.too_small == 0);
  CHECK(wide.farther == 0);
  const Found<T, glint::WideLayout<4>> narrow(glint::wide<4>);
  CHECK(narrow.too_small == 0);
  CHECK(narrow.farther == 0);
  const Found<T, std::remove_const_t<decltype(glint::quantized<8>)>> quantized(glint::quantized<8>);
  CHECK(quantized.too_small == 0);  // its boxes may be larger than what they are in
}

TEMPLATE_TEST_CASE("image bounds: of a diagonal row, turned upright, have its width and not its box's", "[bvh][query]",
                   float, double) {
  using T = TestType;
  // 512 small triangles along (1, 1, 0), which a turn by an eighth lays along y. The box's image is 512 √2 wide; two
  // levels of eight down, boxes have eight triangles, and images that are 9 √2 wide, or twice that in an uneven tree.
  glint::MeshBuffers<T> row;
  for (std::uint32_t i = 0; i < 512; ++i) {
    for (const Vec3<T>& corner : {Vec3<T>{0, 0, 0}, Vec3<T>{1, 0, 0}, Vec3<T>{0, 1, 0}})
      row.positions.push_back(corner + Vec3<T>{T(i), T(i), T(0)});
    row.indices.insert(row.indices.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  }
  const glint::Bvh bvh(view(row));
  const Affine<T> upright = Affine<T>::rotate({T(0), T(0), T(1)}, glint::pi<T> / 4);
  const T width = extent(bvh.image_bounds(upright)).x;
  CHECK(extent(transform(upright, bvh.bounds())).x > T(700));
  CHECK(width > T(1.4));  // √2, of one triangle
  CHECK(width < T(26));
}

TEST_CASE("image bounds: of nothing are empty, of one leaf the image of its box", "[bvh][query]") {
  const glint::MeshBuffers<float> none;
  const glint::Bvh nothing(view(none));
  CHECK(is_empty(nothing.image_bounds(turned(0.5F))));
  const auto few = glint::testing::triangle_soup<float>(2, 3);
  const glint::Bvh leaf(view(few));
  REQUIRE(leaf.nodes().root().is_leaf());
  CHECK(leaf.image_bounds(turned(0.5F)) == transform(turned(0.5F), leaf.bounds()));
}

}  // namespace test_bvh_query_image_bounds
