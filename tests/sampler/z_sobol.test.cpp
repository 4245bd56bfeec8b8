// SPDX-License-Identifier: MIT
#include <glint/sampler/z_sobol.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glint/sampler/sobol.hpp>
#include <glint/testing/sampler_laws.hpp>
#include <support/catch.hpp>

namespace test_sampler_z_sobol {

using glint::Sobol;
using glint::Vec2;
using glint::Vec2i;
using glint::ZSobol;

namespace {

constexpr int edge = 64;

/// By how much each pixel's average of x e^y over its second pair differs from the integral, (e − 1) / 2.
template <typename Q>
std::vector<double> errors(const Q& sequence, int samples, Vec2i corner = {0, 0}) {
  std::vector<double> result;
  for (int i = 0; i < edge * edge; ++i) {
    double sum = 0;
    for (int sample = 0; sample < samples; ++sample) {
      auto sampler = sequence.stream(corner + Vec2i{i % edge, i / edge}, sample);
      static_cast<void>(sampler.next_1d());
      static_cast<void>(sampler.next_2d());
      const Vec2<double> point(sampler.next_2d());
      sum += point.x * std::exp(point.y);
    }
    result.push_back(sum / samples - (std::exp(1.0) - 1) / 2);
  }
  return result;
}

/// The mean square of the image's averages over boxes of width × width, one every `step` pixels.
double energy(const std::vector<double>& image, int width, int step) {
  double squares = 0;
  int boxes = 0;
  for (int top = 0; top + width <= edge; top += step) {
    for (int left = 0; left + width <= edge; left += step, ++boxes) {
      double sum = 0;
      for (int i = 0; i < width * width; ++i) {
        sum += image[static_cast<std::size_t>((top + i / width) * edge + left + i % width)];
      }
      squares += std::pow(sum / (width * width), 2);
    }
  }
  return squares / boxes;
}

/// The same, over sixteen images of different seeds.
template <typename Make>
double mean_energy(const Make& make, int samples, int width, int step) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) sum += energy(errors(make(seed), samples), width, step);
  return sum / 16;
}

}  // namespace

TEST_CASE("z_sobol: obeys the laws of sample sequences", "[sampler][z_sobol][laws]") {
  const int samples = GENERATE(1, 2, 16, 50);
  CAPTURE(samples);
  const auto violations = glint::testing::violations_of_sampler_laws(ZSobol{.samples_per_pixel = samples, .seed = 4},
                                                                     {.samples = 2048, .dispersion = 3});
  for (const std::string& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

TEST_CASE("z_sobol: the samples of each pixel are nets, in each number and in each pair", "[sampler][z_sobol][laws]") {
  const Vec2i pixel = GENERATE(Vec2i{0, 0}, Vec2i{1, 0}, Vec2i{5, 1000}, Vec2i{65535, 65535});
  CAPTURE(pixel.x, pixel.y);
  // 200 counts as 256: twice that are looked at, so the fresh pattern as well.
  CHECK(glint::testing::violations_of_net_laws(ZSobol{.samples_per_pixel = 200}, pixel, 8).empty());
  CHECK(glint::testing::violations_of_net_laws(ZSobol{.samples_per_pixel = 8}, pixel, 3).empty());
}

TEST_CASE("z_sobol: blocks of 2^k x 2^k pixels are nets together", "[sampler][z_sobol]") {
  // In place of a pixel's samples: those of a block of 4 × 4 pixels with 16 samples each, in any order.
  struct Block {
    Vec2i corner;
    [[nodiscard]] auto stream(const Vec2i& /*pixel*/, int sample) const {
      const int pixel = sample / 16 % 16;
      const int further = sample / 256 * 16;  // the law wants a second block: the fresh pattern
      return ZSobol{.samples_per_pixel = 16}.stream(corner + Vec2i{pixel % 4, pixel / 4}, further + sample % 16);
    }
  };
  const Block block{GENERATE(Vec2i{0, 0}, Vec2i{12, 4}, Vec2i{1020, 4092})};
  for (const std::string& violation : glint::testing::violations_of_net_laws(block, {0, 0}, 8)) {
    // Fewer samples than all of the block are not aligned in the sequence.
    CHECK(violation.find("256 samples") == std::string::npos);
  }
}

TEST_CASE("z_sobol: fresh patterns, seeds and tiles are different", "[sampler][z_sobol]") {
  const ZSobol sequence{.samples_per_pixel = 4};
  CHECK(errors(sequence, 4) != errors(ZSobol{.samples_per_pixel = 4, .seed = 1}, 4));
  CHECK(sequence.stream({0, 0}, 0).next_2d() != sequence.stream({0, 0}, 4).next_2d());
  CHECK(errors(sequence, 1) != errors(sequence, 1, {32768, 0}));  // 4 samples: tiles of 2¹⁵ pixels
  CHECK(errors(sequence, 1, {32768, 0}) != errors(sequence, 1, {0, 32768}));
}

TEST_CASE("z_sobol: the average of a block of pixels has the error of as many samples of one pixel",
          "[sampler][z_sobol]") {
  // Blocks of 4 × 4 pixels of n samples each are nets of 16 n samples, so they err as Sobol's pixels of 16 n samples
  // do, and not as the average of 16 independent pixels. The blocks of an image share its scrambling, so that their
  // mean squares are off by tens of percent; the average of sixteen images is good to some ten.
  for (const int samples : {1, 2, 4}) {
    CAPTURE(samples);
    const auto z_sobol = [&](std::uint64_t seed) { return ZSobol{.samples_per_pixel = samples, .seed = seed}; };
    const auto sobol = [](std::uint64_t seed) { return Sobol{.seed = seed}; };
    const double blocks = mean_energy(z_sobol, samples, 4, 4);
    const double pixels = mean_energy(sobol, 16 * samples, 1, 1);
    CHECK(blocks < 1.6 * pixels);
    CHECK(blocks > pixels / 1.6);
    CHECK(mean_energy(sobol, samples, 4, 4) > 20 * blocks);
  }
}

TEST_CASE("z_sobol: a blurred image has far less error than Sobol's, and its pixels have no more",
          "[sampler][z_sobol]") {
  // Boxes of 8 × 8 pixels wherever they begin. By Sobol they err by the variance v of a pixel over 64. Within them lie
  // blocks of 2 × 2: all 16, or 12 and 8 halves, or 9, 12 halves and 4 single pixels, as they begin at even or odd
  // places, which are 1/4, 2/4 and 1/4 of all. Where the error of n samples falls at least with 1/n² (it does with 1/n³
  // for a term linear in x or y), the sum of a block of 2 × 2 has at most 4² v/4² = v; its four errors correlate by
  // −1/4 then, so the sum of two of them has 2 v − 2 v/4 = 1.5 v. Different blocks do not add to each other's error.
  // Thus at most (16 + 2 (12 + 8 · 1.5) + 9 + 12 · 1.5 + 4) / 4 = 23.75 v in place of 64 v: 2.7 times less.
  for (const int samples : {1, 4}) {
    CAPTURE(samples);
    const auto z_sobol = [&](std::uint64_t seed) { return ZSobol{.samples_per_pixel = samples, .seed = seed}; };
    const auto sobol = [](std::uint64_t seed) { return Sobol{.seed = seed}; };
    CHECK(mean_energy(sobol, samples, 8, 1) > 2.7 * mean_energy(z_sobol, samples, 8, 1));
    CHECK(mean_energy(z_sobol, samples, 1, 1) < 1.2 * mean_energy(sobol, samples, 1, 1));
  }
}

TEST_CASE("z_sobol: the error is alike along rows and along columns", "[sampler][z_sobol]") {
  // The curve's first turn is sideways or down by chance, a dimension a coin: over many seeds neither is better.
  double along = 0;
  double down = 0;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    const std::vector<double> image = errors(ZSobol{.samples_per_pixel = 1, .seed = seed}, 1);
    for (std::size_t i = 0; i < image.size(); i += 2) {
      if (i / edge % 2 == 0)
        along += std::pow(image[i] + image[i + 1], 2) + std::pow(image[i + edge] + image[i + edge + 1], 2);
      if (i / edge % 2 == 0)
        down += std::pow(image[i] + image[i + edge], 2) + std::pow(image[i + 1] + image[i + edge + 1], 2);
    }
  }
  CHECK(along / down == Approx(1).epsilon(0.3));
}

}  // namespace test_sampler_z_sobol
