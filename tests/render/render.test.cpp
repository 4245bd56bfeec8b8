// SPDX-License-Identifier: MIT
#include <glint/render/render.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <support/catch.hpp>

#include <glint/bsdf/mirror.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/camera/orthographic.hpp>
#include <glint/camera/panoramic.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/camera/thin_lens.hpp>
#include <glint/core/one_of.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/integrator/bdpt.hpp>
#include <glint/integrator/direct.hpp>
#include <glint/integrator/normals.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/environment.hpp>
#include <glint/material/material_table.hpp>
#include <glint/material/textured.hpp>
#include <glint/sampler/stratified.hpp>
#include <glint/sampler/z_sobol.hpp>
#include <glint/scene/scene.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/texture/filtered_image_texture.hpp>
#include <glint/texture/image_texture.hpp>
#include <glint/texture/mip_map.hpp>

namespace test_render_render {

namespace aov = glint::aov;
using glint::AovLayers;
using glint::Film;
using glint::Path;
using glint::Perspective;
using glint::Ray;
using glint::RenderOptions;
using glint::Rgb;
using glint::Serial;
using glint::Vec2;
using glint::Vec2i;
using glint::Vec3;

namespace {

const std::vector<glint::Sphere<float>> spheres{{.center = {0, 0, 0}}, {.center = {1.5F, 0, 0.5F}, .radius = 0.7F}};
const glint::Scene scene{glint::Bvh{glint::Elements{spheres}}, glint::Lambertian{Rgb{0.7F}},
                         glint::ConstantEnvironment{Rgb{1}}};
const Perspective camera{.eye = {0, 1, 6}};

/// What an image is made of, to the last bit.
std::vector<unsigned char> bytes(const glint::Image& image) {
  std::vector<unsigned char> result(image.pixels().size() * sizeof(Rgb));
  std::memcpy(result.data(), image.pixels().data(), result.size());
  return result;
}

template <typename F>
glint::Image rendered(const F& filter, const RenderOptions& options, const auto& executor, const auto& sequence) {
  Film<F> film{{50, 37}, filter};  // not a multiple of any tile
  render(scene, camera, Path{.max_depth = 4}, film, options, executor, sequence);
  return film.develop();
}

/// Gray that says where on the film a ray came from: 1 right of the middle, 0 left; and what breaks.
struct Constant {
  Rgb value{1};
  Rgb radiance(const auto& /*scene*/, const glint::Ray<float>& /*ray*/, glint::Sampler auto& /*sampler*/) const {
    return value;
  }
};
/// Radiance 1, and light for the second pixel of the third row of a film of 4 × 4.
struct Splatting {
  Rgb radiance(const auto& /*scene*/, const glint::Ray<float>& /*ray*/, glint::Sampler auto& /*sampler*/,
               const auto& /*camera*/, const auto& splat) const {
    splat(glint::Vec2<float>{0.375F, 0.375F}, Rgb{0x1p-5F});
    return 1;
  }
};
struct ShowDirection {
  Rgb radiance(const auto& /*scene*/, const glint::Ray<float>& ray, glint::Sampler auto& /*sampler*/) const {
    return {ray.direction.x > 0 ? 1.0F : 0.0F, ray.direction.y > 0 ? 1.0F : 0.0F, 0.0F};
  }
};

/// Radiance 1, and a wish to stop.
struct StopsIt {
  std::stop_source* stop;

  template <glint::SceneLike S, glint::Sampler R>
  [[nodiscard]] Rgb radiance(const S& /*scene*/, const glint::Ray<float>& /*ray*/, R& /*sampler*/) const {
    stop->request_stop();
    return Rgb{1};
  }
};

/// Radiance between 0 and 1, evenly.
struct Uniform {
  Rgb radiance(const auto& /*scene*/, const Ray<float>& /*ray*/, glint::Sampler auto& sampler) const {
    return sampler.next_1d();
  }
};
/// Broken for one ray in two.
struct HalfBroken {
  Rgb radiance(const auto& /*scene*/, const Ray<float>& /*ray*/, glint::Sampler auto& sampler) const {
    return sampler.next_1d() < 0.5F ? std::numeric_limits<float>::quiet_NaN() : 1.0F;
  }
};

/// All variables, but for those that not every integrator has.
auto surface_layers(Vec2i size) {
  return AovLayers{size,
                   aov::Albedo{},
                   aov::Normal{},
                   aov::DenoiseAlbedo{},
                   aov::DenoiseNormal{},
                   aov::Depth{},
                   aov::Position{},
                   aov::Uv{},
                   aov::PrimitiveId{},
                   aov::InstanceId{},
                   aov::MaterialId{},
                   aov::SampleCount{}};
}
auto light_layers(Vec2i size) {
  return AovLayers{size,          aov::Albedo{},   aov::DenoiseAlbedo{}, aov::PrimitiveId{}, aov::Emission{},
                   aov::Direct{}, aov::Indirect{}, aov::Variance{}};
}

/// Balls of clay and of mirror under a sky.
const auto mixed_scene = [] {
  using Surface = glint::OneOf<glint::Lambertian, glint::Mirror>;
  return glint::Scene{glint::Bvh{glint::Elements{spheres}},
                      glint::MaterialTable<Surface>{{glint::Lambertian{Rgb{0.7F}}, glint::Mirror{Rgb{0.9F}}}, {0, 1}},
                      glint::ConstantEnvironment{Rgb{1}}};
}();

/// Fails unless the film's image is the one without layers, to the last bit. Gives the layers.
template <typename I, typename L>
glint::Layers check_same_image(const I& integrator, L layers, const auto& executor) {
  const glint::GaussianFilter wide{.radius = 1.5F};
  const RenderOptions options{.samples = 5, .tile_size = 16};
  Film plain{{50, 37}, wide};
  const auto report = render(mixed_scene, camera, integrator, plain, options, executor, glint::ZSobol{});
  Film film{{50, 37}, wide};
  const auto with_layers = render(mixed_scene, camera, integrator, film, layers, options, executor, glint::ZSobol{});
  CHECK((bytes(film.develop()) == bytes(plain.develop())));
  CHECK(with_layers.samples == report.samples);
  CHECK(with_layers.rays > report.rays);
  return std::move(layers).layers();
}

/// The mean of what a pixel's samples meet on the plane z = 0, in closed form and double; nothing where none does.
struct OnPlane {
  Vec3<double> position{0.0};
  double depth = 0;
  int hits = 0;

  void add(const Ray<float>& ray, double reach) {
    const Vec3<double> origin(ray.origin);
    const Vec3<double> direction(ray.direction);
    const double t = -origin.z / direction.z;
    const Vec3<double> p = origin + t * direction;
    if (!(t > 0) || std::abs(p.x) > reach || std::abs(p.y) > reach) return;
    position += p;
    depth += glm::length(p - origin);
    ++hits;
  }
};

/// Renders the wall [−10, 10]² in the plane z = 0 and compares every pixel with the closed form.
template <typename C>
void check_plane(const C& camera_of_wall) {
  const std::vector<glint::Quad<float>> wall{{{-10, -10, 0}, {20, 0, 0}, {0, 20, 0}}};
  const glint::Scene wall_scene{glint::Bvh{glint::Elements{wall}}};
  const Vec2i size{24, 16};
  constexpr int samples = 4;
  const glint::Independent sequence{.seed = 3};
  Film film{size};
  AovLayers layers{size, aov::Depth{}, aov::Position{}, aov::Uv{}, aov::Normal{}};
  render(wall_scene, camera_of_wall, Constant{}, film, layers, {.samples = samples}, Serial{}, sequence);
  const auto rays = camera_of_wall.rays(1.5F);
  int hit_pixels = 0;
  for (int i = 0; i < size.x * size.y; ++i) {
    const Vec2i pixel{i % size.x, i / size.x};
    OnPlane expected;
    for (int sample = 0; sample < samples; ++sample) {
      auto sampler = sequence.stream(pixel, sample);
      const Vec2<float> jitter = sampler.next_2d();
      const Vec2<float> lens = sampler.next_2d();
      const Vec2<float> at = (Vec2<float>(pixel) + jitter) / Vec2<float>(size);
      expected.add(rays.ray({at.x, 1 - at.y}, lens), 10);
    }
    const auto shown = [&](const char* channel) {
      return static_cast<double>(find_channel(layers.layers(), channel)->at(static_cast<std::size_t>(i)));
    };
    CAPTURE(pixel.x, pixel.y, expected.hits);
    CHECK(shown("N.Z") == Approx(expected.hits / double{samples}));
    if (expected.hits == 0) {
      CHECK(std::isinf(shown("Z")));
      continue;
    }
    ++hit_pixels;
    const Vec3<double> mean = expected.position / static_cast<double>(expected.hits);
    // In float: a few roundings of coordinates up to 10, magnified by the slant of the ray.
    CHECK(shown("Z") == Approx(expected.depth / expected.hits).epsilon(1e-5));
    CHECK(shown("P.X") == Approx(mean.x).margin(1e-4));
    CHECK(shown("P.Y") == Approx(mean.y).margin(1e-4));
    CHECK(shown("P.Z") == Approx(0).margin(1e-5));
    CHECK(shown("uv.U") == Approx((mean.x + 10) / 20).margin(1e-5));
    CHECK(shown("uv.V") == Approx((mean.y + 10) / 20).margin(1e-5));
  }
  CHECK(hit_pixels > 40);
}

}  // namespace

TEST_CASE("render: the same bits for every number of threads and every tile size", "[render]") {
  const glint::Independent independent{.seed = 5};
  const glint::GaussianFilter wide{.radius = 1.5F};
  const auto expected = bytes(rendered(wide, {.samples = 3}, Serial{}, independent));
  for (const int threads : {1, 2, 5}) {
    for (const int tile_size : {1, 16, 40, 1000}) {
      CAPTURE(threads, tile_size);
      const glint::TbbExecutor executor(threads);
      CHECK(bytes(rendered(wide, {.samples = 3, .tile_size = tile_size}, executor, independent)) == expected);
    }
  }
}

TEST_CASE("render: the same bits with stratified samples too", "[render]") {
  const glint::Stratified stratified{.samples_per_pixel = 4, .seed = 5};
  const auto expected = bytes(rendered(glint::BoxFilter{}, {.samples = 4}, Serial{}, stratified));
  CHECK(bytes(rendered(glint::BoxFilter{}, {.samples = 4}, glint::TbbExecutor(3), stratified)) == expected);
}

TEST_CASE("render: the same bits with light paths that splat anywhere", "[render]") {
  const auto splatted = [](const auto& executor, int tile_size) {
    Film film{{50, 37}};
    const auto report =
        render(scene, camera, glint::Bdpt{.max_depth = 4}, film, {.samples = 3, .tile_size = tile_size}, executor);
    CHECK(report.dropped == 0);
    CHECK_FALSE(film.splats().empty());
    return bytes(film.develop());
  };
  const auto expected = splatted(Serial{}, 32);
  CHECK(splatted(glint::TbbExecutor(1), 16) == expected);
  CHECK(splatted(glint::TbbExecutor(4), 16) == expected);
}

TEST_CASE("render: a splat adds to its pixel what one path for each pixel would bring", "[render]") {
  Film film{{4, 4}};
  render(scene, camera, Splatting{}, film, {.samples = 2});
  CHECK(film.develop()(1, 2) == Rgb{1.5F});  // 1 by the camera's paths, 16 · 1/32 by all splats
  CHECK(film.develop()(0, 0) == Rgb{1});
}

TEST_CASE("render: another seed, other noise", "[render]") {
  const auto one = rendered(glint::BoxFilter{}, {.samples = 1}, Serial{}, glint::Independent{.seed = 1});
  const auto two = rendered(glint::BoxFilter{}, {.samples = 1}, Serial{}, glint::Independent{.seed = 2});
  CHECK_FALSE(one == two);
}

TEST_CASE("render: the image's right is the camera's right, and its top row is up", "[render]") {
  Film film{{8, 8}};
  render(scene, Perspective{}, ShowDirection{}, film, {.samples = 2});
  const glint::Image image = film.develop();
  CHECK(image(7, 0) == Rgb{1, 1, 0});
  CHECK(image(0, 7) == Rgb{0});
  CHECK(image(7, 7) == Rgb{1, 0, 0});
}

TEST_CASE("render: the report counts samples and rays", "[render]") {
  Film film{{20, 10}};
  const auto report = render(scene, camera, Path{.max_depth = 1}, film, {.samples = 3});
  CHECK(report.samples == 600);  // 20 · 10 · 3
  CHECK(report.rays == 600);     // one segment each
  CHECK(report.dropped == 0);
  CHECK(report.complete);
  CHECK(report.seconds >= 0);
}

TEST_CASE("render: samples that are not finite are left out and counted", "[render]") {
  Film film{{4, 4}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto report = render(scene, camera, Constant{Rgb{1, nan, 1}}, film, {.samples = 2});
  CHECK(report.dropped == 32);
  CHECK(film.develop()(0, 0) == Rgb{0});
}

TEST_CASE("render: progress grows to the total, one call at a time", "[render]") {
  Film film{{64, 64}};
  std::vector<glint::RenderProgress> seen;  // unguarded: calls do not overlap
  RenderOptions options{.samples = 2, .tile_size = 16};
  options.progress = [&](const glint::RenderProgress& progress) { seen.push_back(progress); };
  render(scene, camera, Constant{}, film, options, glint::TbbExecutor(4));
  REQUIRE(seen.size() == 16);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    CHECK(seen[i].samples_done == (i + 1) * 16 * 16 * 2);
    CHECK(seen[i].samples_total == 64 * 64 * 2);
  }
}

TEST_CASE("render: a stop request ends it after the tiles at hand", "[render]") {
  Film film{{64, 64}};
  std::stop_source stop;
  RenderOptions options{.samples = 1, .tile_size = 16};
  options.stop = stop.get_token();
  options.progress = [&](const glint::RenderProgress&) { stop.request_stop(); };
  const auto report = render(scene, camera, Constant{}, film, options);
  CHECK_FALSE(report.complete);
  CHECK(report.samples == 16 * 16);
  CHECK(film.develop()(0, 0) == Rgb{1});
  CHECK(film.develop()(63, 63) == Rgb{0});
}

TEST_CASE("render: a stop request ends a tile after the pixel at hand", "[render]") {
  Film film{{64, 64}};
  std::stop_source stop;
  int calls = 0;
  RenderOptions options{.samples = 3, .tile_size = 64};
  options.stop = stop.get_token();
  options.progress = [&](const glint::RenderProgress&) { ++calls; };
  const auto report = render(scene, camera, StopsIt{&stop}, film, options);
  CHECK_FALSE(report.complete);
  CHECK(report.samples == 3);  // of one pixel
  CHECK(calls == 0);           // no tile was finished
}

TEST_CASE("render: what the progress callback throws comes out", "[render]") {
  Film film{{32, 32}};
  RenderOptions options{.samples = 1};
  options.progress = [](const glint::RenderProgress&) { throw std::runtime_error("enough"); };
  CHECK_THROWS_AS(render(scene, camera, Constant{}, film, options, glint::TbbExecutor(2)), std::runtime_error);
}

TEST_CASE("render: no samples leave the film black", "[render]") {
  Film film{{4, 4}};
  CHECK(render(scene, camera, Constant{}, film, {.samples = 0}).samples == 0);
  CHECK(film.develop()(1, 1) == Rgb{0});
}

TEST_CASE("render: layers beside the film leave the image as it is, to the last bit", "[render][aov]") {
  const Serial serial;
  check_same_image(Path{}, light_layers({50, 37}), serial);
  check_same_image(Path{.strategy = glint::LightStrategy::RandomWalk}, light_layers({50, 37}), serial);
  check_same_image(Path{.clamp = {.indirect = 0.2F}}, light_layers({50, 37}), serial);
  check_same_image(glint::Direct{}, light_layers({50, 37}), serial);
  check_same_image(Path{}, surface_layers({50, 37}), serial);
  check_same_image(glint::Bdpt{.max_depth = 4}, surface_layers({50, 37}), serial);
  check_same_image(glint::Normals{}, surface_layers({50, 37}), serial);
}

TEST_CASE("render: layers have the same bits for every number of threads", "[render][aov]") {
  const auto expected = check_same_image(Path{}, light_layers({50, 37}), Serial{});
  CHECK(check_same_image(Path{}, light_layers({50, 37}), glint::TbbExecutor(4)) == expected);
  const auto surfaces = check_same_image(glint::Bdpt{}, surface_layers({50, 37}), Serial{});
  CHECK(check_same_image(glint::Bdpt{}, surface_layers({50, 37}), glint::TbbExecutor(4)) == surfaces);
}

TEST_CASE("render: depth, position and texture coordinates are those of the plane, by every camera", "[render][aov]") {
  check_plane(Perspective{.eye = {1, -2, 7}, .target = {0, 1, 0}});
  check_plane(glint::ThinLens{{1, -2, 7}, {0, 1, 0}, {0, 1, 0}, 0.9F, 0.3F, 7});
  check_plane(glint::Orthographic{.eye = {1, -2, 7}, .target = {0, 1, 0}, .height = 9});
  check_plane(glint::Panoramic{.eye = {1, -2, 3}, .target = {0, 1, 0}});
}

TEST_CASE("render: ids are those of the closest primitive at pixel centers, whatever the samples", "[render][aov]") {
  const auto soup = glint::testing::triangle_soup<float>(300, 5);
  glint::MaterialTable<glint::Lambertian> materials{.materials = {{}, {}, {}}};
  for (std::uint32_t i = 0; i < 300; ++i) materials.of_primitive.push_back(i % 3);
  const glint::Scene soup_scene{glint::Bvh{view(soup)}, materials};
  const Perspective eye{.eye = {0.5F, 0.4F, 3}};
  const Vec2i size{60, 40};
  Film film{size};
  AovLayers layers{size, aov::PrimitiveId{}, aov::MaterialId{}};
  render(soup_scene, eye, Constant{}, film, layers, {.samples = 1});
  const auto& primitives = std::get<std::vector<std::uint32_t>>(layers.layers().channels[0].values);
  const auto& of_material = std::get<std::vector<std::uint32_t>>(layers.layers().channels[1].values);
  const auto rays = eye.rays(1.5F);
  int hits = 0;
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      const Vec2<float> center{(static_cast<float>(x) + 0.5F) * (1 / 60.0F),
                               1 - (static_cast<float>(y) + 0.5F) * (1 / 40.0F)};
      const auto hit = soup_scene.geometry().closest(rays.ray(center, {0.5F, 0.5F}));
      const auto i = static_cast<std::size_t>(y * size.x + x);
      REQUIRE(primitives[i] == (hit ? hit->primitive : 4'294'967'295U));
      REQUIRE(of_material[i] == (hit ? hit->primitive % 3 : 4'294'967'295U));
      hits += hit ? 1 : 0;
    }
  }
  CHECK(hits > 100);
}

TEST_CASE("render: emission, direct and indirect light make up the picture", "[render][aov]") {
  const auto layers_of = [](const auto& integrator) {
    Film film{{50, 37}};
    auto layers = light_layers(film.size());
    render(mixed_scene, camera, integrator, film, layers, {.samples = 6});
    const glint::Image image = film.develop();
    const auto part = [&](const char* layer) { return *image_of(layers.layers(), layer); };
    const glint::Image emission = part("emission");
    const glint::Image direct = part("direct");
    const glint::Image indirect = part("indirect");
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
      const Rgb sum = emission.pixels()[i] + direct.pixels()[i] + indirect.pixels()[i];
      REQUIRE(sum.g == Approx(image.pixels()[i].g).epsilon(1e-6));  // rounded a few times
    }
    return std::move(layers).layers();
  };
  const glint::Layers of_path = layers_of(Path{});
  // The top row sees the sky alone; the middle of the film the ball of clay, which is no lamp.
  const glint::Image emission = *image_of(of_path, "emission");
  const glint::Image indirect = *image_of(of_path, "indirect");
  CHECK(emission(25, 0) == Rgb{1});
  CHECK(emission(24, 20) == Rgb{0});
  CHECK((*image_of(of_path, "direct"))(24, 20).g > 0.1F);
  double sum = 0;
  for (const Rgb& pixel : indirect.pixels()) sum += static_cast<double>(pixel.g);
  CHECK(sum > 1);
  layers_of(glint::Direct{});
}

TEST_CASE("render: the variance of a mean of uniform numbers is 1 / 12 over their count", "[render][aov]") {
  constexpr int n = 16;
  Film film{{64, 64}};
  AovLayers layers{film.size(), aov::Variance{}, aov::SampleCount{}};
  render(scene, camera, Uniform{}, film, layers, {.samples = n});
  const glint::Image variance = *image_of(layers.layers(), "variance");
  double mean_estimate = 0;
  double spread = 0;  // of the pixels' means around ½
  for (std::size_t i = 0; i < variance.pixels().size(); ++i) {
    mean_estimate += static_cast<double>(variance.pixels()[i].g) / 4096;
    spread += std::pow(static_cast<double>(film.develop().pixels()[i].g) - 0.5, 2) / 4096;
    REQUIRE(layers.layers().channels[3].at(i) == n);
  }
  const double expected = 1.0 / 12 / n;
  // An estimate from 16 uniform numbers has the relative variance 2/15 − 1.2/16 = 0.058; of 4096 the mean 0.0038².
  CHECK(std::abs(mean_estimate / expected - 1) < 4 * 0.0038);
  CHECK(std::abs(spread / expected - 1) < 4 * std::sqrt(2.0 / 4096));
}

TEST_CASE("render: the variance is that of pixels over many seeds", "[render][aov]") {
  constexpr int seeds = 200;
  const Vec2i size{4, 4};
  std::vector<glint::SampleStatistics> over_seeds(16);
  double estimated = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    Film film{size};
    AovLayers layers{size, aov::Variance{}};
    render(mixed_scene, camera, Path{}, film, layers, {.samples = 16}, Serial{},
           glint::Independent{.seed = static_cast<std::uint64_t>(seed)});
    const glint::Image image = film.develop();
    for (std::size_t i = 0; i < 16; ++i) {
      over_seeds[i].add(image.pixels()[i]);
      estimated += static_cast<double>(layers.layers().channels[1].at(i)) / seeds;
    }
  }
  double measured = 0;
  for (const auto& pixel : over_seeds) measured += static_cast<double>(pixel.variance_of_mean().g) * seeds;
  // A variance from k numbers is off by √(2 / (k − 1)) where they are Gaussian, as means of 16 nearly are: by a tenth
  // for one pixel of 200 seeds, by less for all. Four times that for the brightest of them alone is generous.
  CHECK(measured > 0);
  CHECK(std::abs(estimated / measured - 1) < 0.2);
}

TEST_CASE("render: samples that are not finite are in no layer", "[render][aov]") {
  Film film{{8, 8}};
  AovLayers layers{film.size(), aov::SampleCount{}, aov::Variance{}};
  const auto report = render(scene, camera, HalfBroken{}, film, layers, {.samples = 10});
  double counted = 0;
  for (std::size_t i = 0; i < 64; ++i) counted += static_cast<double>(layers.layers().channels[0].at(i));
  CHECK(report.dropped > 100);
  CHECK(counted == 640 - static_cast<double>(report.dropped));
  CHECK(layers.layers().channels[1].at(0) == 0);
}

TEST_CASE("render: the report says where light was clamped", "[render]") {
  Film film{{4, 4}};
  CHECK_FALSE(render(scene, camera, Path{}, film, {.samples = 1}).clamped);
  CHECK(render(scene, camera, Path{.clamp = {.direct = 1}}, film, {.samples = 1}).clamped);
  CHECK_FALSE(render(scene, camera, Constant{}, film, {.samples = 1}).clamped);
}

TEST_CASE("render: filtered textures have the mean of unfiltered ones, and a fraction of their noise", "[render]") {
  // A floor to the horizon, its texture repeated a hundred times, under an even sky: what is seen is the texture
  // itself.
  const std::vector<glint::Quad<float>> floor{{{-100, 0, 0}, {200, 0, 0}, {0, 0, -200}}};
  glint::Image image(Vec2i{32, 32});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) image(x, y) = (x / 16 + y / 16) % 2 == 0 ? 0.9F : 0.1F;
  }
  const glint::UvMapping often{{100, 100}, {0, 0}};
  const auto pixels = std::make_shared<const glint::Image>(image);
  const glint::ImageTexture bilinear{.image = pixels, .mapping = often};
  glint::FilteredImageTexture filtered{.pyramid = std::make_shared<const glint::MipMap>(pixels), .mapping = often};
  const auto seen = [&](const auto& texture, int samples) {
    const glint::Scene floor_scene{glint::Bvh{glint::Elements{floor}},
                                   glint::Textured<glint::Lambertian, std::remove_cvref_t<decltype(texture)>>{texture},
                                   glint::ConstantEnvironment{Rgb{1}}};
    Film<glint::BoxFilter> film{{32, 16}};
    // The lower half of the view is floor, and its upper rows lie toward the horizon.
    render(floor_scene, Perspective{.eye = {0, 2, 0}, .target = {0, 2, -1}},
           Path{.max_depth = 2, .strategy = glint::LightStrategy::RandomWalk}, film, {.samples = samples},
           glint::TbbExecutor{}, glint::Stratified{.samples_per_pixel = samples});
    return film.develop();
  };
  const glint::Image reference = seen(bilinear, 4096);
  struct Error {
    double squared = 0;
    double bias = 0;
  };
  const auto error_of = [&](const glint::Image& found) {
    Error error;
    for (int y = 9; y < 12; ++y) {  // 5 to 15 texels wide, and many times as long
      for (int x = 0; x < 32; ++x) {
        const double off = double(found(x, y).g) - double(reference(x, y).g);
        error.squared += off * off / 96;
        error.bias += off / 96;
      }
    }
    return error;
  };
  const Error without = error_of(seen(bilinear, 4));
  for (const auto filter : {glint::TextureFilter::Ewa, glint::TextureFilter::Trilinear}) {
    filtered.filter = filter;
    const Error with = error_of(seen(filtered, 4));
    CAPTURE(static_cast<int>(filter), with.squared, without.squared, with.bias);
    CHECK(with.squared < 0.1 * without.squared);
    CHECK(std::abs(with.bias) < 0.01);
  }
}

}  // namespace test_render_render
