// SPDX-License-Identifier: MIT
#include <glint/testing/primitive_laws.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <optional>

#include <support/catch.hpp>

#include <glint/geometry/sphere.hpp>

namespace test_testing_primitive_laws {

namespace {

using Ray = glint::Ray<float>;
using Hit = glint::Hit<float>;
using Vec3 = glint::Vec3<float>;
using Aabb = glint::Aabb<float>;

/// A sound sphere with just one thing broken by the derived type; free functions of the derived type are found first.
struct Base {
  glint::Sphere<float> sphere{.center = {1, 2, 3}, .radius = 2};
};
std::optional<Hit> intersect(const Ray& ray, const Base& p) {
  return intersect(ray, p.sphere);
}
Aabb bounds(const Base& p) {
  return bounds(p.sphere);
}
glint::Surface surface(const Base& p, const Vec3& position) {
  return surface(p.sphere, position);
}
float area(const Base& p) {
  return area(p.sphere);
}
glint::AreaSample<float> sample_area(const Base& p, const glint::Vec2<float>& u) {
  return sample_area(p.sphere, u);
}

struct IgnoresInterval : Base {};
std::optional<Hit> intersect(const Ray& ray, const IgnoresInterval& p) {
  return intersect(Ray{.origin = ray.origin, .direction = ray.direction, .t_min = -glint::infinity<float>}, p.sphere);
}

struct ExcludesEnds : Base {};
std::optional<Hit> intersect(const Ray& ray, const ExcludesEnds& p) {
  const auto hit = intersect(ray, p.sphere);
  return hit && hit->t > ray.t_min && hit->t < ray.t_max ? hit : std::nullopt;
}

struct HasEpsilon : Base {};
std::optional<Hit> intersect(Ray ray, const HasEpsilon& p) {
  ray.t_min = std::max(ray.t_min, 1e-3F);
  return intersect(ray, p.sphere);
}

struct NormalizesDirection : Base {};
std::optional<Hit> intersect(Ray ray, const NormalizesDirection& p) {
  ray.direction = glm::normalize(ray.direction);
  return intersect(ray, p.sphere);
}

struct OnlyFarSide : Base {};
std::optional<Hit> intersect(Ray ray, const OnlyFarSide& p) {
  const auto first = intersect(ray, p.sphere);
  if (!first) return first;
  ray.t_min = std::nextafter(first->t, glint::infinity<float>);
  const auto second = intersect(ray, p.sphere);
  return second ? second : first;
}

struct HitsNan : Base {};
std::optional<Hit> intersect(const Ray& ray, const HitsNan& p) {
  if (std::isnan(ray.origin.y)) return Hit{.t = 1};
  return intersect(ray, p.sphere);
}

struct HitsZeroDirection : Base {};
std::optional<Hit> intersect(const Ray& ray, const HitsZeroDirection& p) {
  if (ray.direction == Vec3(0.0F)) return Hit{.t = 0};
  return intersect(ray, p.sphere);
}

struct TooSmallBounds : Base {};
Aabb bounds(const TooSmallBounds& p) {
  return bounds(glint::Sphere<float>{p.sphere.center, p.sphere.radius * 0.99F});
}

struct EmptyBounds : Base {
  EmptyBounds() : Base{{.center = {0, 0, 0}, .radius = 0.5F}} {}
};
Aabb bounds(const EmptyBounds&) {
  return {};
}

struct LongNormals : Base {};
glint::Surface surface(const LongNormals& p, const Vec3& position) {
  auto at = surface(p.sphere, position);
  at.normal *= 1.01F;
  return at;
}

struct SlantedNormals : Base {};
glint::Surface surface(const SlantedNormals& p, const Vec3& position) {
  auto at = surface(p.sphere, position);
  at.normal = glm::normalize(at.normal + Vec3(0.3F, 0, 0));
  at.tangent = Vec3(0.0F);
  return at;
}

struct MovedPosition : Base {};
glint::Surface surface(const MovedPosition& p, const Vec3& position) {
  auto at = surface(p.sphere, position);
  at.position += at.normal * 1e-3F;
  return at;
}

struct WideError : Base {};
glint::Surface surface(const WideError& p, const Vec3& position) {
  auto at = surface(p.sphere, position);
  at.position_error = Vec3(0.01F);
  return at;
}

struct TangentOffPlane : Base {};
glint::Surface surface(const TangentOffPlane& p, const Vec3& position) {
  auto at = surface(p.sphere, position);
  at.tangent += at.normal;
  return at;
}

struct BitangentMirrored : Base {};
glint::Surface surface(const BitangentMirrored& p, const Vec3& position) {
  auto at = surface(p.sphere, position);
  at.bitangent = -at.bitangent;
  return at;
}

struct WrongArea : Base {};
float area(const WrongArea& p) {
  return area(p.sphere) * 1.2F;
}

struct CrowdedSamples : Base {};
glint::AreaSample<float> sample_area(const CrowdedSamples& p, glint::Vec2<float> u) {
  u.x *= u.x;
  return sample_area(p.sphere, u);
}

struct SamplesOffSurface : Base {};
glint::AreaSample<float> sample_area(const SamplesOffSurface& p, const glint::Vec2<float>& u) {
  auto sample = sample_area(p.sphere, u);
  sample.surface.position += sample.surface.normal * 0.5F;
  return sample;
}

struct WrongDensity : Base {};
glint::AreaSample<float> sample_area(const WrongDensity& p, const glint::Vec2<float>& u) {
  auto sample = sample_area(p.sphere, u);
  sample.pdf *= 2;
  return sample;
}

/// The only law a primitive breaks, or all of them in one text.
template <typename P>
std::string broken(const P& primitive) {
  std::string all;
  for (const auto& sentence : glint::testing::violations_of_primitive_laws(primitive, 1)) all += sentence + '\n';
  return all;
}

bool names(const std::string& sentences, const char* law) {
  return sentences.find(law) != std::string::npos;
}

}  // namespace

TEST_CASE("primitive laws: a sound primitive breaks none", "[testing][laws]") {
  CHECK(broken(Base{}).empty());
}

TEST_CASE("primitive laws: an intersector that ignores the interval is told so", "[testing][laws]") {
  CHECK(names(broken(IgnoresInterval{}), "a hit's t lies in the interval"));
  CHECK(names(broken(IgnoresInterval{}), "what lies behind the origin is not hit"));
}

TEST_CASE("primitive laws: the ends of the interval belong to it", "[testing][laws]") {
  CHECK(names(broken(ExcludesEnds{}), "an interval that ends at the hit keeps it"));
  CHECK(names(broken(ExcludesEnds{}), "an interval that begins at the hit keeps it"));
}

TEST_CASE("primitive laws: an absolute epsilon shows when the direction is scaled", "[testing][laws]") {
  CHECK(names(broken(HasEpsilon{}), "t scales inversely with the length of the direction"));
}

TEST_CASE("primitive laws: t counts multiples of the direction, not units of length", "[testing][laws]") {
  CHECK(names(broken(NormalizesDirection{}), "t scales inversely with the length of the direction"));
}

TEST_CASE("primitive laws: the first hit must be found, not the second", "[testing][laws]") {
  CHECK(names(broken(OnlyFarSide{}), "an interval that ends before the first hit finds nothing"));
}

TEST_CASE("primitive laws: broken rays hit nothing", "[testing][laws]") {
  CHECK(names(broken(HitsNan{}), "a NaN in the origin hits nothing"));
  CHECK(names(broken(HitsZeroDirection{}), "a zero direction hits nothing"));
}

TEST_CASE("primitive laws: bounds hold all hits", "[testing][laws]") {
  CHECK(names(broken(TooSmallBounds{}), "a hit lies in the bounds"));
  CHECK(names(broken(EmptyBounds{}), "a primitive with empty bounds is never hit"));
}

TEST_CASE("primitive laws: shading data must be sound", "[testing][laws]") {
  CHECK(names(broken(LongNormals{}), "normals have unit length"));
  CHECK(names(broken(SlantedNormals{}), "normals are perpendicular to the surface"));
  CHECK(names(broken(MovedPosition{}), "the surface's position is the ray's point"));
  CHECK(names(broken(WideError{}), "the position's error bound is a few roundings"));
  CHECK(names(broken(TangentOffPlane{}), "tangents are perpendicular to normals"));
  CHECK(names(broken(BitangentMirrored{}), "tangents say how texture coordinates change"));
}

TEST_CASE("primitive laws: area, samples and densities must agree with what rays find", "[testing][laws]") {
  CHECK(names(broken(WrongArea{}), "the area is what random lines measure"));
  CHECK(names(broken(CrowdedSamples{}), "sampled points are uniform by area"));
  CHECK(names(broken(SamplesOffSurface{}), "a ray toward a sampled point finds it"));
  CHECK(names(broken(WrongDensity{}), "the density of a sampled point is 1 / area"));
}

TEST_CASE("primitive laws: a violation is a sentence that names the ray", "[testing][laws]") {
  const auto sentences = glint::testing::violations_of_primitive_laws(HitsZeroDirection{}, 1);
  REQUIRE(sentences.size() == 1);
  CHECK(names(sentences.front(), "along (0, 0, 0)"));
}

}  // namespace test_testing_primitive_laws
