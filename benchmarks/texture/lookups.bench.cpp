// SPDX-License-Identifier: MIT
// What a lookup in an image texture costs, by filter and by the size and shape of the footprint.
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glint/color/image.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/texture/filtered_image_texture.hpp>
#include <glint/texture/image_texture.hpp>
#include <glint/texture/mip_map.hpp>

#include <support/bench.hpp>

namespace {

using namespace glint;

constexpr int size = 1024;
constexpr std::size_t lookup_count = 4096;

/// A random image, and places in it next to each other as those of neighboring pixels are.
struct Input {
  std::shared_ptr<const Image> image;
  std::shared_ptr<const MipMap> pyramid;
  std::vector<Vec2<float>> places;
  double mean = 0;

  Input() {
    Image pixels(Vec2i{size, size});
    Random random(1);
    for (Rgb& pixel : pixels.pixels()) {
      pixel = random.uniform<float>();
      mean += double(pixel.g) / (double(size) * size);
    }
    image = std::make_shared<const Image>(std::move(pixels));
    pyramid = std::make_shared<const MipMap>(image);
    for (std::size_t i = 0; i < lookup_count; ++i) {
      const auto row = static_cast<float>(i / 64);
      const auto column = static_cast<float>(i % 64);
      places.push_back(Vec2<float>{column + random.uniform<float>(), row + random.uniform<float>()} / 64.0F);
    }
  }
};

const Input& input() {
  static const Input all;
  return all;
}

/// Looks up all places; their mean must be the image's.
template <typename Lookup>
void measure(benchmark::State& state, const Lookup& lookup) {
  Rgb sum;
  for (auto _ : state) {
    sum = 0;
    for (const Vec2<float>& uv : input().places) sum += lookup(uv);
    benchmark::DoNotOptimize(sum);
  }
  state.counters["Mlookups/s"] =
      benchmark::Counter(double(lookup_count) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
  // Uniform pixels have the deviation 0.29: the mean of 4096 of them is off by 0.0045, five times that in a million
  // runs.
  const double mean = double(sum.g) / double(lookup_count);
  bench::verify(state, std::abs(mean - input().mean) < 0.0225, "the mean of the lookups is not the image's");
}

void plain(benchmark::State& state, Interpolation interpolation) {
  const ImageTexture texture{.image = input().image, .interpolation = interpolation};
  measure(state, [&](const Vec2<float>& uv) { return texture.evaluate(uv); });
}

/// A footprint of that width in pixels, so many times as long, at an angle.
void filtered(benchmark::State& state, TextureFilter filter, float width, float anisotropy) {
  const FilteredImageTexture texture{.pyramid = input().pyramid, .filter = filter};
  const float angle = 0.5F;
  const Vec2<float> along = Vec2<float>{std::cos(angle), std::sin(angle)} * (width / size);
  const UvFootprint over{along * anisotropy, {-along.y, along.x}};
  measure(state, [&](const Vec2<float>& uv) { return texture.evaluate(uv, over); });
}

void register_all(const bench::Options& /*options*/) {
  benchmark::RegisterBenchmark("nearest", [](benchmark::State& s) { plain(s, Interpolation::Nearest); });
  benchmark::RegisterBenchmark("bilinear", [](benchmark::State& s) { plain(s, Interpolation::Bilinear); });
  for (const float anisotropy : {1.0F, 4.0F, 8.0F}) {
    for (const float width : {0.5F, 3.0F, 20.0F}) {
      const std::string name = std::to_string(width).substr(0, 4) + "_by_" + std::to_string(anisotropy).substr(0, 1);
      benchmark::RegisterBenchmark(("trilinear/" + name).c_str(), [=](benchmark::State& s) {
        filtered(s, TextureFilter::Trilinear, width, anisotropy);
      });
      benchmark::RegisterBenchmark(("ewa/" + name).c_str(),
                                   [=](benchmark::State& s) { filtered(s, TextureFilter::Ewa, width, anisotropy); });
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run(argc, argv, register_all);
}
