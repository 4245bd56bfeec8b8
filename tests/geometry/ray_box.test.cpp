// SPDX-License-Identifier: MIT
#include <glint/geometry/ray_box.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <nlohmann/json.hpp>

#include <support/catch.hpp>
#include <support/shared.hpp>

namespace test_geometry_ray_box {

namespace {

using glint::Aabb;
using glint::component;
using glint::infinity;
using glint::Ray;
using glint::Vec3;

template <typename Test, typename T>
std::optional<glint::Interval<T>> overlap(const Ray<T>& ray, const Aabb<T>& box) {
  return Test::intersect(Test::prepare(ray), box, ray.t_min, ray.t_max);
}

template <typename T>
Vec3<T> vec_of(const nlohmann::json& value) {
  if (value.is_string()) return Vec3<T>(value.get<std::string>() == "+inf" ? infinity<T> : -infinity<T>);
  return {value[0].get<T>(), value[1].get<T>(), value[2].get<T>()};
}

/// The slab test by cases, in a wider type: the definition.
template <typename T>
bool overlaps_exactly(const Ray<T>& ray, const Aabb<T>& box) {
  long double entry = ray.t_min;
  long double exit = ray.t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const long double o = component(ray.origin, axis);
    const long double d = component(ray.direction, axis);
    const long double lower = component(box.lower, axis);
    const long double upper = component(box.upper, axis);
    if (d == 0) {
      if (o < lower || o > upper) return false;
      continue;
    }
    const long double near = ((d > 0 ? lower : upper) - o) / d;
    const long double far = ((d > 0 ? upper : lower) - o) / d;
    entry = std::max(entry, near);
    exit = std::min(exit, far);
  }
  return entry <= exit;
}

}  // namespace

TEMPLATE_TEST_CASE("ray/box: agrees with the reference cases", "[geometry][ray_box][vectors]", float, double) {
  using T = TestType;
  const auto text = glint::testing::shared_file("vectors/aabb.json");
  if (!text) return;
  const auto vectors = nlohmann::json::parse(*text);
  for (const auto& example : vectors["cases"]) {
    INFO(example["name"].get<std::string>());
    const Aabb<T> box{vec_of<T>(example["lo"]), vec_of<T>(example["hi"])};
    Ray<T> ray{vec_of<T>(example["o"]), vec_of<T>(example["d"]), example.value("t_min", T(1e-4)),
               example.value("t_max", T(1e7))};
    const bool expected = example["hit"].get<bool>();
    CHECK(intersect(ray, box).has_value() == expected);
    CHECK(overlap<glint::FastSlab>(ray, box).has_value() == expected);
    CHECK(overlap<glint::ConservativeSlab>(ray, box).has_value() == expected);
    if (!example.contains("t_in")) continue;
    ray.t_min = -infinity<T>;  // the file's distances are not clipped to the ray's interval
    ray.t_max = infinity<T>;
    const auto span = overlap<glint::FastSlab>(ray, box);
    REQUIRE(span);
    CHECK(std::abs(span->lower - example["t_in"].get<T>()) <= T(1e-6));
    CHECK(std::abs(span->upper - example["t_out"].get<T>()) <= T(1e-6));
  }
}

TEMPLATE_TEST_CASE("ray/box: a ray in the plane of a face hits, whatever the sign of its zeros", "[geometry][ray_box]",
                   float, double) {
  using T = TestType;
  const T zero = GENERATE(T(0), -T(0));
  const T height = GENERATE(T(-1), T(1));
  const Aabb<T> cube{Vec3<T>(T(-1)), Vec3<T>(T(1))};
  const Ray<T> in_face{{T(-2), height, T(0)}, {T(1), zero, zero}};
  const Ray<T> along_edge{{T(-2), height, height}, {T(1), zero, zero}};
  const Ray<T> outside{{T(-2), height * T(1.001), T(0)}, {T(1), zero, zero}};
  for (const Ray<T>& ray : {in_face, along_edge}) {
    const auto fast = overlap<glint::FastSlab>(ray, cube);
    REQUIRE(fast);
    CHECK(fast->lower == T(1));  // from x = −2 to the faces x = −1 and x = 1, exactly
    CHECK(fast->upper == T(3));
    CHECK(overlap<glint::ConservativeSlab>(ray, cube));
    CHECK(intersect(ray, cube) == fast);
  }
  CHECK_FALSE(overlap<glint::FastSlab>(outside, cube));
  CHECK_FALSE(overlap<glint::ConservativeSlab>(outside, cube));
  CHECK_FALSE(intersect(outside, cube));
}

TEMPLATE_TEST_CASE("ray/box: flat boxes and points are hit, also from within their plane", "[geometry][ray_box]", float,
                   double) {
  using T = TestType;
  const T zero = GENERATE(T(0), -T(0));
  const Aabb<T> sheet{{T(-1), T(0.3), T(-1)}, {T(1), T(0.3), T(1)}};
  const Aabb<T> point{Vec3<T>(T(0.3)), Vec3<T>(T(0.3))};
  CHECK(intersect(Ray<T>{{T(0.1), T(5), T(0.2)}, {zero, T(-1), zero}}, sheet));
  CHECK(intersect(Ray<T>{{T(-3), T(0.3), T(0.2)}, {T(1), zero, zero}}, sheet));
  CHECK(intersect(Ray<T>{{T(-3), T(0.3), T(0.3)}, {T(1), zero, zero}}, point));
  CHECK_FALSE(intersect(Ray<T>{{T(-3), T(0.31), T(0.3)}, {T(1), zero, zero}}, point));
}

TEMPLATE_TEST_CASE("ray/box: both ends of the interval are inclusive", "[geometry][ray_box]", float, double) {
  using T = TestType;
  const Aabb<T> cube{Vec3<T>(T(-1)), Vec3<T>(T(1))};
  Ray<T> ray{{T(-2), T(0), T(0)}, {T(1), T(0), T(0)}};  // inside for t in [1, 3]
  ray.t_max = T(1);
  CHECK(intersect(ray, cube));
  ray.t_max = std::nextafter(T(1), T(0));
  CHECK_FALSE(intersect(ray, cube));
  ray.t_max = infinity<T>;
  ray.t_min = T(3);
  CHECK(intersect(ray, cube));
  ray.t_min = std::nextafter(T(3), T(4));
  CHECK_FALSE(intersect(ray, cube));
}

TEMPLATE_TEST_CASE("ray/box: empty boxes, NaN rays and zero directions meet nothing", "[geometry][ray_box]", float,
                   double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const Aabb<T> cube{Vec3<T>(T(-1)), Vec3<T>(T(1))};
  const Aabb<T> huge{Vec3<T>(-std::numeric_limits<T>::max()), Vec3<T>(std::numeric_limits<T>::max())};
  const Ray<T> good{{T(0), T(0), T(0)}, {T(1), T(1), T(0)}};
  REQUIRE(intersect(good, cube));
  const std::array<Aabb<T>, 3> empty{Aabb<T>{}, Aabb<T>{{T(-1), T(1), T(-1)}, {T(1), T(-1), T(1)}},
                                     Aabb<T>{{T(-1), T(-1), T(0.5)}, {T(1), T(1), T(0)}}};
  for (const Aabb<T>& box : empty) {
    CHECK_FALSE(intersect(good, box));
    CHECK_FALSE(overlap<glint::FastSlab>(good, box));
    CHECK_FALSE(overlap<glint::ConservativeSlab>(good, box));
  }
  const std::array<Ray<T>, 7> bad{Ray<T>{{nan, T(0), T(0)}, {T(1), T(0), T(0)}},
                                  Ray<T>{{T(0), T(0), nan}, {T(1), T(0), T(0)}},
                                  Ray<T>{{T(0), T(0), T(0)}, {T(1), nan, T(0)}},
                                  Ray<T>{{T(0), T(0), T(0)}, {T(0), T(0), T(0)}},
                                  Ray<T>{{T(0), T(0), T(0)}, {T(0), -T(0), T(0)}},
                                  Ray<T>{{T(0), T(0), T(0)}, {T(1), T(0), T(0)}, nan},
                                  Ray<T>{{T(0), T(0), T(0)}, {T(1), T(0), T(0)}, T(0), nan}};
  for (const Ray<T>& ray : bad) {
    for (const Aabb<T>& box : {cube, huge}) {
      CHECK_FALSE(intersect(ray, box));
      CHECK_FALSE(overlap<glint::FastSlab>(ray, box));
      CHECK_FALSE(overlap<glint::ConservativeSlab>(ray, box));
    }
  }
  CHECK_FALSE(intersect(good, Aabb<T>{Vec3<T>(nan), Vec3<T>(T(1))}));
}

TEMPLATE_TEST_CASE("ray/box: the conservative test misses no box that the ray truly meets", "[geometry][ray_box]",
                   float, double) {
  using T = TestType;
  // Rays are aimed at corners and points of edges, where the exact answer hangs on the last bit; some coordinates come
  // from a small set, so that planes and zero components coincide. long double is exact enough to be the judge: it
  // calls a hit only where the ray meets a box shrunk by nothing, with 2^-64 relative error.
  std::mt19937 random(7);
  std::uniform_real_distribution<T> uniform(T(-1), T(1));
  const auto coordinate = [&] { return random() % 4 == 0 ? T(int(random() % 5) - 2) / 2 : uniform(random); };
  int hits = 0;
  int missed_by_conservative = 0;
  int found_far_outside = 0;
  for (int i = 0; i < 200000; ++i) {
    Aabb<T> box;
    extend(box, Vec3<T>{coordinate(), coordinate(), coordinate()});
    extend(box, Vec3<T>{coordinate(), coordinate(), coordinate()});
    const Vec3<T> origin{coordinate() * 3, coordinate() * 3, coordinate() * 3};
    const auto pick = [&](T a, T b) { return random() % 3 == 0 ? a : random() % 2 == 0 ? b : a + (b - a) / 3; };
    const Vec3<T> target{pick(box.lower.x, box.upper.x), pick(box.lower.y, box.upper.y),
                         pick(box.lower.z, box.upper.z)};
    const Ray<T> ray{origin, target - origin};
    const bool truth = overlaps_exactly(ray, box);
    hits += truth ? 1 : 0;
    const bool found = overlap<glint::ConservativeSlab>(ray, box).has_value();
    missed_by_conservative += truth && !found ? 1 : 0;
    const Vec3<T> margin = (abs(box.lower) + abs(box.upper) + abs(origin)) * (32 * std::numeric_limits<T>::epsilon());
    const Aabb<T> grown{box.lower - margin, box.upper + margin};
    found_far_outside += found && !overlaps_exactly(ray, grown) ? 1 : 0;
  }
  CHECK(hits > 100000);
  CHECK(missed_by_conservative == 0);
  CHECK(found_far_outside == 0);
}

}  // namespace test_geometry_ray_box
