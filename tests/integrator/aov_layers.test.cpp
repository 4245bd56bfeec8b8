// SPDX-License-Identifier: MIT
#include <glint/integrator/aov_layers.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/bvh/brute_force.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/scene/scene.hpp>

namespace test_integrator_aov_layers {

namespace aov = glint::aov;
using glint::AovLayers;
using glint::LightShares;
using glint::Ray;
using glint::Rgb;

namespace {

const std::vector<glint::Sphere<float>> spheres{{.center = {0, 0, -4}}};
const glint::Scene scene{glint::BruteForce{glint::Elements{spheres}}, glint::Lambertian{Rgb{0.5F}}};
const Ray<float> hits{};
const Ray<float> misses{.direction = {0, 0, 1}};

/// The x of where a ray begins; without a value below zero.
struct OriginX {
  using Value = float;
  static constexpr std::string_view name = "origin";
  static constexpr std::array<std::string_view, 1> channels{"origin.x"};

  template <glint::SceneLike S>
  [[nodiscard]] std::optional<float> at_surface(const S& /*scene*/, const Ray<float>& ray, const auto& /*at*/,
                                                const auto& /*sampler*/) const {
    if (ray.origin.x < 0) return std::nullopt;
    return ray.origin.x;
  }
};

void add(auto& pixel, const Ray<float>& ray, const LightShares& light = {}) {
  pixel.add(scene, ray, glint::Independent{}.stream({0, 0}, 0), light);
}
float value(const auto& layers, const char* channel, std::size_t i) {
  const glint::Channel* const found = find_channel(layers.layers(), channel);
  REQUIRE(found != nullptr);
  return found->at(i);
}

}  // namespace

TEST_CASE("aov layers: a channel for each component, integers where they count or name", "[integrator][aov_layers]") {
  const AovLayers layers{{3, 2}, aov::Normal{}, aov::Depth{}, aov::PrimitiveId{}};
  std::vector<std::string> names;
  for (const glint::Channel& channel : layers.layers().channels) {
    names.push_back(channel.name);
    CHECK(channel.size() == 6);
    CHECK(std::holds_alternative<std::vector<std::uint32_t>>(channel.values) == (channel.name == "primitive_id"));
  }
  CHECK(names == std::vector<std::string>{"N.X", "N.Y", "N.Z", "Z", "primitive_id"});
}

TEST_CASE("aov layers: those that were chosen by name, in the order of the list", "[integrator][aov_layers]") {
  using Three = AovLayers<aov::Normal, aov::Depth, aov::PrimitiveId>;
  CHECK(glint::layer_names(Three({1, 1}, {"primitive_id", "depth"}).layers()) ==
        std::vector<std::string>{"Z", "primitive_id"});
  CHECK(Three({1, 1}, std::vector<std::string>{"Z"}).layers().channels.empty());
  CHECK(Three::names[2] == "primitive_id");
}

TEST_CASE("aov layers: a pixel is the mean of the samples that have a value", "[integrator][aov_layers]") {
  AovLayers layers{{2, 2}, OriginX{}, aov::Depth{}, aov::Albedo{}};
  auto pixel = layers.pixel({1, 0});
  for (const float x : {0.25F, -3.0F, 0.75F}) add(pixel, {.origin = {x, 0, 0}, .direction = {-x / 4, 0, -1}});
  add(pixel, misses);
  pixel.write();
  CHECK(value(layers, "origin.x", 1) == Approx((0.25 + 0.75 + 0) / 3));
  CHECK(value(layers, "albedo.R", 1) == Approx(0.5 * 3 / 4));  // black where nothing is
  // Toward the center, one radius before it: √(x² + 4²) − 1.
  const auto depth = [](double x) { return std::sqrt(x * x + 16) - 1; };
  CHECK(value(layers, "Z", 1) == Approx((depth(0.25) + depth(3) + depth(0.75)) / 3));
  CHECK(value(layers, "origin.x", 0) == 0);  // a pixel of which nothing was written
}

TEST_CASE("aov layers: where no sample has a value, depth is infinite, all else zero", "[integrator][aov_layers]") {
  AovLayers layers{{1, 1}, aov::Depth{}, aov::Position{}, aov::Variance{}, aov::SampleCount{}, aov::Direct{}};
  auto pixel = layers.pixel({0, 0});
  add(pixel, misses, {.direct = Rgb{2}, .sum = Rgb{2}});
  pixel.write();
  CHECK(value(layers, "Z", 0) == std::numeric_limits<float>::infinity());
  CHECK(value(layers, "P.X", 0) == 0);
  CHECK(value(layers, "samples", 0) == 1);
  CHECK(value(layers, "direct.G", 0) == 2);
}

TEST_CASE("aov layers: ids are those of the ray that is written with", "[integrator][aov_layers]") {
  AovLayers layers{{2, 1}, aov::PrimitiveId{}, aov::SampleCount{}};
  const auto write = [&](int x, const Ray<float>& center) {
    auto pixel = layers.pixel({x, 0});
    CHECK(pixel.asks_for_hit<decltype(scene)>());
    add(pixel, misses);
    pixel.write(scene, scene.closest(center));
  };
  write(0, hits);
  write(1, misses);
  const auto& ids = std::get<std::vector<std::uint32_t>>(find_channel(layers.layers(), "primitive_id")->values);
  CHECK(ids == std::vector<std::uint32_t>{0, 4'294'967'295U});
  CHECK(value(layers, "samples", 0) == 1);

  AovLayers none{{2, 1}, aov::SampleCount{}};
  CHECK_FALSE(none.pixel({0, 0}).asks_for_hit<decltype(scene)>());
}

TEST_CASE("aov layers: what is not finite is left out", "[integrator][aov_layers]") {
  AovLayers layers{{1, 1}, OriginX{}};
  auto pixel = layers.pixel({0, 0});
  add(pixel, {.origin = {std::numeric_limits<float>::infinity(), 0, 0}});
  add(pixel, {.origin = {4, 0, 0}});
  pixel.write();
  CHECK(value(layers, "origin.x", 0) == 4);
}

TEST_CASE("aov layers: a rendering begins each pixel anew", "[integrator][aov_layers]") {
  AovLayers layers{{1, 1}, OriginX{}};
  for (const float x : {8.0F, 2.0F}) {
    auto pixel = layers.pixel({0, 0});
    add(pixel, {.origin = {x, 0, 0}});
    pixel.write();
  }
  CHECK(value(layers, "origin.x", 0) == 2);
}

}  // namespace test_integrator_aov_layers
