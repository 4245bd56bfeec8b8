// SPDX-License-Identifier: MIT
#include <glint/render/render.hpp>  // first, so the header proves it stands alone

#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include <support/catch.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/bdpt.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/environment.hpp>
#include <glint/sampler/stratified.hpp>
#include <glint/scene/scene.hpp>

using glint::Film;
using glint::Path;
using glint::Perspective;
using glint::RenderOptions;
using glint::Rgb;
using glint::Serial;
using glint::Vec2i;

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
