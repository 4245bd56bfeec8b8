// SPDX-License-Identifier: MIT
#include <glint/testing/set_laws.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

namespace test_testing_set_laws {

namespace {

using glint::Aabb;
using glint::Elements;
using glint::Hit;
using glint::Ray;
using glint::Sphere;
using glint::Vec3;
using glint::testing::violations_of_set_laws;

enum class Slip { None, TightBounds, WrongIndex, OpenEnd, FarClosest, TightClip, Occluded };

/// Spheres with a slip.
struct Broken {
  using Scalar = float;
  using Index = std::uint32_t;

  Elements<Sphere<float>> spheres;
  Slip slip = Slip::None;

  [[nodiscard]] std::size_t size() const { return spheres.size(); }
  [[nodiscard]] Aabb<float> bounds(Index i) const {
    const Aabb<float> box = spheres.bounds(i);
    return slip == Slip::TightBounds ? Aabb<float>{box.lower * 0.8F, box.upper} : box;
  }
  [[nodiscard]] std::optional<Hit<float>> intersect(const Ray<float>& ray, Index i) const {
    auto hit = spheres.intersect(ray, i);
    if (hit && slip == Slip::WrongIndex) hit->primitive = 0;
    if (hit && slip == Slip::OpenEnd && hit->t == ray.t_max) return std::nullopt;
    return hit;
  }
  [[nodiscard]] bool occluded(const Ray<float>& ray, Index i) const {
    return spheres.intersect(ray, i).has_value() != (slip == Slip::Occluded && i == 2);
  }
  [[nodiscard]] Vec3<float> closest_point(const Vec3<float>& point, Index i) const {
    return slip == Slip::FarClosest ? spheres[i].center * 2.0F - spheres.closest_point(point, i)
                                    : spheres.closest_point(point, i);
  }
  [[nodiscard]] Aabb<float> clip(Index i, const Aabb<float>& cell) const {
    const Aabb<float> part = overlap(spheres.bounds(i), cell);
    return slip == Slip::TightClip ? Aabb<float>{part.lower, centroid(part)} : part;
  }
};

const std::vector<Sphere<float>> spheres{{{0, 0, 0}, 1}, {{1, 1, 0}, 0.7F}, {{-1, 0.5F, 0.5F}, 0.9F}};

}  // namespace

TEMPLATE_TEST_CASE("set laws: hold for the library's sets", "[testing][set_laws]", float, double) {
  using T = TestType;
  const auto soup = glint::testing::triangle_soup<T>(40, 3);
  const std::vector<Sphere<T>> balls{{{0, 0, 0}, 1}, {{1, 1, 0}, T(0.7)}};
  const auto accept = [](const auto& /*ray*/, const auto& hit) { return hit.primitive != 1; };
  CHECK(violations_of_set_laws(view(soup), 1) == std::vector<std::string>{});
  CHECK(violations_of_set_laws(Elements{balls}, 2) == std::vector<std::string>{});
  CHECK(violations_of_set_laws(glint::Filtered{Elements{balls}, accept}, 3) == std::vector<std::string>{});
  CHECK(violations_of_set_laws(glint::Joined{view(soup), Elements{balls}}, 4) == std::vector<std::string>{});
}

TEST_CASE("set laws: find each slip, and name it", "[testing][set_laws]") {
  const auto names = [](Slip slip, const std::string& law) {
    const auto broken = violations_of_set_laws(Broken{Elements{spheres}, slip}, 5);
    return std::any_of(broken.begin(), broken.end(), [&](const std::string& s) { return s.find(law) == 0; });
  };
  CHECK(violations_of_set_laws(Broken{Elements{spheres}}, 5) == std::vector<std::string>{});
  CHECK(names(Slip::TightBounds, "bounds hold every hit"));
  CHECK(names(Slip::WrongIndex, "a hit carries the index of its primitive"));
  CHECK(names(Slip::OpenEnd, "both ends of a ray count"));
  CHECK(names(Slip::FarClosest, "no hit is closer to a point than the closest point"));
  CHECK(names(Slip::TightClip, "clip holds every hit in the cell"));
  CHECK(names(Slip::Occluded, "occluded says whether intersect finds something"));
}

}  // namespace test_testing_set_laws
