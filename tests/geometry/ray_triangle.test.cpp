// SPDX-License-Identifier: MIT
#include <glint/geometry/ray_triangle.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <nlohmann/json.hpp>

#include <support/catch.hpp>
#include <support/closed_meshes.hpp>
#include <support/shared.hpp>

namespace test_geometry_ray_triangle {

namespace {

using glint::length_squared;
using glint::MoellerTrumbore;
using glint::Ray;
using glint::Vec3;
using glint::Watertight;

template <typename Test, typename Scalar>
struct Tested {
  using Intersector = Test;
  using T = Scalar;
};

using FastFloat = Tested<MoellerTrumbore, float>;
using FastDouble = Tested<MoellerTrumbore, double>;
using ClosedFloat = Tested<Watertight, float>;
using ClosedDouble = Tested<Watertight, double>;

template <typename Test, typename T>
auto shoot(const Ray<T>& ray, const std::array<Vec3<T>, 3>& v) {
  return Test::intersect(ray, Test::prepare(ray), v[0], v[1], v[2]);
}

template <typename T>
Vec3<T> vec_of(const nlohmann::json& value) {
  return {value[0].get<T>(), value[1].get<T>(), value[2].get<T>()};
}

/// How many triangles the ray hits.
template <typename T>
int crossings(const Ray<T>& ray, const glint::MeshBuffers<T>& mesh) {
  const auto prepared = Watertight::prepare(ray);
  int hits = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto hit = Watertight::intersect(ray, prepared, mesh.positions[mesh.indices[i]],
                                           mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]);
    hits += hit ? 1 : 0;
  }
  return hits;
}

/// Rays that pass no triangle, among rays aimed at vertices and edges of a star-shaped mesh from inside and from
/// outside to the inside, after the mesh was moved by `shift`.
template <typename T>
int leaks(glint::MeshBuffers<T> mesh, const Vec3<T>& shift, int rays, unsigned seed) {
  for (Vec3<T>& position : mesh.positions) position += shift;
  std::mt19937 random(seed);
  std::uniform_real_distribution<T> uniform(T(0), T(1));
  std::uniform_int_distribution<std::size_t> corner(0, mesh.indices.size() - 1);
  int leaks = 0;
  for (int i = 0; i < rays; ++i) {
    const std::size_t from = corner(random);
    const Vec3<T> a = mesh.positions[mesh.indices[from]];
    const Vec3<T> b = mesh.positions[mesh.indices[from - from % 3 + (from + 1) % 3]];
    const int kind = i % 4;  // a vertex, the middle of an edge, or any point of it
    const T along = kind == 0 ? T(0) : kind == 1 ? T(0.5) : uniform(random);
    const Vec3<T> target = a + (b - a) * along;
    const Vec3<T> jitter = Vec3<T>{uniform(random), uniform(random), uniform(random)} - Vec3<T>(T(0.5));
    const Vec3<T> inside = shift + jitter * (i % 3 == 0 ? T(0) : T(0.01));
    const Ray<T> outward{inside, target - inside};
    const Vec3<T> outside = target + (target - inside) * T(3);
    const Ray<T> inward{.origin = outside, .direction = target - outside, .t_max = T(4) / T(3)};
    leaks += crossings(outward, mesh) == 0 ? 1 : 0;
    leaks += crossings(inward, mesh) == 0 ? 1 : 0;
  }
  return leaks;
}

}  // namespace

TEMPLATE_TEST_CASE("ray/triangle: agrees with the reference cases", "[geometry][ray_triangle][vectors]", FastFloat,
                   FastDouble, ClosedFloat, ClosedDouble) {
  using T = typename TestType::T;
  using Test = typename TestType::Intersector;
  const auto text = glint::testing::shared_file("vectors/triangle.json");
  if (!text) return;
  const auto vectors = nlohmann::json::parse(*text);
  for (const auto& example : vectors["cases"]) {
    INFO(example["name"].get<std::string>());
    const auto& v = example["v"];
    const Ray<T> ray{vec_of<T>(example["o"]), vec_of<T>(example["d"]), example.value("t_min", T(1e-4)),
                     example.value("t_max", T(1e7))};
    const auto hit = shoot<Test, T>(ray, {vec_of<T>(v[0]), vec_of<T>(v[1]), vec_of<T>(v[2])});
    if (example["hit"].is_boolean()) CHECK(hit.has_value() == example["hit"].get<bool>());
    if (!hit) continue;
    const T tolerance = T(1e-4);  // the file's own
    CHECK(length_squared(ray.at(hit->t) - vec_of<T>(example["p"])) <= tolerance * tolerance);
    if (example.contains("t")) CHECK(std::abs(hit->t - example["t"].get<T>()) <= tolerance);
    if (example.contains("u")) CHECK(std::abs(hit->uv.x - example["u"].get<T>()) <= tolerance);
    if (example.contains("bv")) CHECK(std::abs(hit->uv.y - example["bv"].get<T>()) <= tolerance);
  }
}

TEMPLATE_TEST_CASE("ray/triangle: tiny and huge triangles are hit from both sides", "[geometry][ray_triangle]",
                   FastFloat, FastDouble, ClosedFloat, ClosedDouble) {
  using T = typename TestType::T;
  using Test = typename TestType::Intersector;
  const T size = std::ldexp(T(1), GENERATE(-30, -17, 0, 17, 30));
  const T side = GENERATE(T(-1), T(1));
  // The ray goes through w1 = 1/4, w2 = 1/2 along z; every number is a power of two, so the answer is exact.
  const Ray<T> ray{{size / 4, size / 2, -side * size}, {T(0), T(0), side}};
  const auto hit = shoot<Test, T>(ray, {Vec3<T>(T(0)), Vec3<T>{size, T(0), T(0)}, Vec3<T>{T(0), size, T(0)}});
  REQUIRE(hit);
  CHECK(hit->t == size);
  CHECK(hit->uv.x == T(0.25));
  CHECK(hit->uv.y == T(0.5));
}

TEMPLATE_TEST_CASE("ray/triangle: both ends of the interval are inclusive", "[geometry][ray_triangle]", FastFloat,
                   FastDouble, ClosedFloat, ClosedDouble) {
  using T = typename TestType::T;
  using Test = typename TestType::Intersector;
  const std::array<Vec3<T>, 3> v{Vec3<T>{T(0), T(0), T(0)}, Vec3<T>{T(1), T(0), T(0)}, Vec3<T>{T(0), T(1), T(0)}};
  Ray<T> ray{{T(0.25), T(0.25), T(-1)}, {T(0), T(0), T(0.5)}, T(2), T(2)};  // t = 1 / 0.5
  CHECK(shoot<Test>(ray, v));
  ray.t_min = std::nextafter(T(2), T(3));
  ray.t_max = T(3);
  CHECK_FALSE(shoot<Test>(ray, v));
  ray.t_min = T(0);
  ray.t_max = std::nextafter(T(2), T(1));
  CHECK_FALSE(shoot<Test>(ray, v));
}

TEMPLATE_TEST_CASE("ray/triangle: triangles without area, NaNs and zero directions meet nothing",
                   "[geometry][ray_triangle]", FastFloat, FastDouble, ClosedFloat, ClosedDouble) {
  using T = typename TestType::T;
  using Test = typename TestType::Intersector;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const std::array<Vec3<T>, 3> good{Vec3<T>{T(0), T(0), T(0)}, Vec3<T>{T(1), T(0), T(0)}, Vec3<T>{T(0), T(1), T(0)}};
  const Vec3<T> target{T(0.25), T(0.25), T(0)};
  REQUIRE(shoot<Test>(Ray<T>{{T(0), T(0), T(1)}, target - Vec3<T>{T(0), T(0), T(1)}}, good));
  for (int i = 0; i < 3; ++i) {
    auto broken = good;
    broken[std::size_t(i)].y = nan;
    CHECK_FALSE(shoot<Test>(Ray<T>{{T(0.2), T(0.2), T(1)}, {T(0), T(0), T(-1)}}, broken));
  }
  CHECK_FALSE(shoot<Test>(Ray<T>{{T(0.2), T(0.2), T(0)}, {T(0), T(0), T(0)}}, good));
  CHECK_FALSE(shoot<Test>(Ray<T>{{T(0.2), nan, T(1)}, {T(0), T(0), T(-1)}}, good));
  CHECK_FALSE(shoot<Test>(Ray<T>{{T(0.2), T(0.2), T(1)}, {nan, T(0), T(-1)}}, good));
  std::mt19937 random(5);
  std::uniform_real_distribution<T> uniform(T(-1), T(1));
  const auto point = [&] { return Vec3<T>{uniform(random), uniform(random), uniform(random)}; };
  const auto grid = [&] { return T(int(random() % 17) - 8); };
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    // Three points on a line, exactly: small integers; or two that are equal.
    const Vec3<T> start{grid(), grid(), grid()};
    const Vec3<T> step{grid(), grid(), grid()};
    const std::array<Vec3<T>, 3> line{start, start + step * grid(), start + step * grid()};
    const Vec3<T> a = point();
    const Vec3<T> b = point();
    const Vec3<T> origin = point() * T(9);
    hits += shoot<Test>(Ray<T>{origin, (line[0] + line[1]) * T(0.5) - origin}, line) ? 1 : 0;
    hits += shoot<Test, T>(Ray<T>{origin, (a + b) * T(0.5) - origin}, {a, b, b}) ? 1 : 0;
    hits += shoot<Test, T>(Ray<T>{origin, a - origin}, {a, b, a}) ? 1 : 0;
    hits += shoot<Test, T>(Ray<T>{origin, a - origin}, {a, a, a}) ? 1 : 0;
  }
  CHECK(hits == 0);
}

TEMPLATE_TEST_CASE("ray/triangle: agrees with long double on random triangles", "[geometry][ray_triangle]", FastFloat,
                   FastDouble, ClosedFloat, ClosedDouble) {
  using T = typename TestType::T;
  using Test = typename TestType::Intersector;
  // Away from edges, and where the ray is not nearly parallel to the plane, the answer is unambiguous; the weights and
  // t are then off by some roundings times the condition, which the limits below hold under 100.
  std::mt19937 random(11);
  std::uniform_real_distribution<T> uniform(T(-1), T(1));
  const auto point = [&] { return Vec3<T>{uniform(random), uniform(random), uniform(random)}; };
  using Exact = glm::vec<3, long double, glm::packed_highp>;
  const auto tolerance = 400 * std::numeric_limits<T>::epsilon();
  int judged = 0;
  int hits = 0;
  int wrong = 0;
  for (int i = 0; i < 50000; ++i) {
    const std::array<Vec3<T>, 3> v{point(), point(), point()};
    const Ray<T> ray{point() * T(2), point() * T(3)};
    const Exact e1 = Exact(v[1]) - Exact(v[0]);
    const Exact e2 = Exact(v[2]) - Exact(v[0]);
    const Exact s = Exact(ray.origin) - Exact(v[0]);
    const Exact d = Exact(ray.direction);
    const long double det = glm::dot(glm::cross(d, e2), e1);
    if (std::abs(det) < 0.1L * glm::length(d)) continue;
    const long double w1 = glm::dot(glm::cross(d, e2), s) / det;
    const long double w2 = glm::dot(glm::cross(s, e1), d) / det;
    const long double t = glm::dot(glm::cross(s, e1), e2) / det;
    const long double least = std::min({w1, w2, 1 - w1 - w2});
    if (std::abs(least) < tolerance || std::abs(t) < tolerance) continue;
    ++judged;
    const bool truth = least > 0 && t > 0;
    const auto hit = shoot<Test>(ray, v);
    if (hit.has_value() != truth) ++wrong;
    if (!hit || !truth) continue;
    ++hits;
    const bool close = std::abs(hit->t - t) <= tolerance * std::max(1.0L, t) && std::abs(hit->uv.x - w1) <= tolerance &&
                       std::abs(hit->uv.y - w2) <= tolerance;
    wrong += close ? 0 : 1;
  }
  CHECK(judged > 20000);
  CHECK(hits > 500);
  CHECK(wrong == 0);
}

TEMPLATE_TEST_CASE("watertight: no ray leaks through the edges and vertices of a closed mesh",
                   "[geometry][ray_triangle]", float, double) {
  using T = TestType;
  using namespace glint::testing;
  const Vec3<T> shift = GENERATE(Vec3<T>(T(0)), Vec3<T>{T(100.3), T(-57.1), T(0.7)});
  CHECK(leaks(tetrahedron<T>(), shift, 150000, 1) == 0);
  CHECK(leaks(octahedron<T>(), shift, 100000, 2) == 0);
  CHECK(leaks(subdivided_sphere<T>(3), shift, 2000, 3) == 0);
  CHECK(leaks(rough_sphere<T>(2, 4), shift, 10000, 4) == 0);
}

TEMPLATE_TEST_CASE("watertight: an edge seen exactly end-on or through its middle is hit", "[geometry][ray_triangle]",
                   float, double) {
  using T = TestType;
  const auto mesh = glint::testing::octahedron<T>();
  // Along an axis, through two vertices where four triangles meet, and through the middles of two edges.
  CHECK(crossings(Ray<T>{{T(0), T(0), T(3)}, {T(0), T(0), T(-1)}}, mesh) == 8);
  CHECK(crossings(Ray<T>{{T(2), T(2), T(0)}, {T(-1), T(-1), T(0)}}, mesh) == 4);
}

TEMPLATE_TEST_CASE("degenerate: three points on a line, and nothing thinner than rounding is called so",
                   "[geometry][ray_triangle]", float, double) {
  using T = TestType;
  const Vec3<T> a{T(1), T(2), T(3)};
  const Vec3<T> step{T(3), T(-1), T(2)};
  CHECK(glint::is_degenerate(a, a, a));
  CHECK(glint::is_degenerate(a, a + step, a + step * T(3)));
  Vec3<T> off = a + step * T(3);
  off.x = std::nextafter(off.x, T(100));
  CHECK_FALSE(glint::is_degenerate(a, a + step, off));
}

}  // namespace test_geometry_ray_triangle
