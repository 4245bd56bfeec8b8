// SPDX-License-Identifier: MIT
#include <glint/testing/sampler_laws.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <string>
#include <vector>

#include <glint/math/low_discrepancy.hpp>
#include <glint/math/random.hpp>
#include <support/catch.hpp>

namespace test_testing_sampler_laws {

using glint::Random;
using glint::Vec2;
using glint::Vec2i;
using glint::testing::violations_of_sampler_laws;

namespace {

/// Lawful but for what `change` does to each number.
template <typename Change>
struct Changed {
  Change change;

  struct Stream {
    Random random;
    Change change;

    float next_1d() { return change(random); }
    Vec2<float> next_2d() {
      const float x = change(random);
      const float y = change(random);
      return {x, y};
    }
  };
  [[nodiscard]] Stream stream(const Vec2i& pixel, int sample) const {
    const auto x = static_cast<std::uint64_t>(pixel.x);
    const auto y = static_cast<std::uint64_t>(pixel.y);
    return {Random{glint::mix(x << 32 | y, static_cast<std::uint64_t>(sample))}, change};
  }
};
template <typename Change>
Changed(Change) -> Changed<Change>;

/// The same numbers in every pixel.
struct EqualPixels {
  [[nodiscard]] auto stream(const Vec2i& /*pixel*/, int sample) const {
    return Changed{[](Random& random) { return random.uniform<float>(); }}.stream({0, 0}, sample);
  }
};

/// The next pixel has nearly the numbers of the last.
struct SlowPixels {
  [[nodiscard]] auto stream(const Vec2i& pixel, int sample) const {
    return Changed{[](Random& random) { return random.uniform<float>(); }}.stream({pixel.x / 2, pixel.y}, sample);
  }
};

/// Every number of a path is the same.
struct Repeating {
  struct Stream {
    float x;
    [[nodiscard]] float next_1d() const { return x; }
    [[nodiscard]] Vec2<float> next_2d() const { return {x, x}; }
  };
  [[nodiscard]] Stream stream(const Vec2i& pixel, int sample) const {
    const auto seed = static_cast<std::uint64_t>(pixel.x + 1000 * pixel.y);
    return {Random{seed, static_cast<std::uint64_t>(sample)}.uniform<float>()};
  }
};

/// One generator for all streams, as a sampler with hidden state has it.
struct Impure {
  Random* random;
  struct Stream {
    Random* random;
    [[nodiscard]] float next_1d() const { return random->uniform<float>(); }
    [[nodiscard]] Vec2<float> next_2d() const { return random->uniform_vec2(); }
  };
  [[nodiscard]] Stream stream(const Vec2i& /*pixel*/, int /*sample*/) const { return {random}; }
};

/// Sobol's points as they are, but for what `shift` adds to the second coordinate of pairs.
struct Net {
  float shift = 0;

  struct Stream {
    glint::Vec2<float> point;
    [[nodiscard]] float next_1d() const { return point.x; }
    [[nodiscard]] Vec2<float> next_2d() const { return point; }
  };
  [[nodiscard]] Stream stream(const Vec2i& /*pixel*/, int sample) const {
    const auto point = glint::sobol_point(static_cast<std::uint32_t>(sample));
    const float y = glint::to_unit_float<float>(point[1]) + shift;
    return {{glint::to_unit_float<float>(point[0]), y < 1 ? y : y - 1}};
  }
};

bool mentions(const std::vector<std::string>& violations, const std::string& word) {
  for (const std::string& violation : violations) {
    if (violation.find(word) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("sampler_laws: a lawful sequence is not accused", "[testing][sampler_laws]") {
  CHECK(violations_of_sampler_laws(Changed{[](Random& random) { return random.uniform<float>(); }}).empty());
}

TEST_CASE("sampler_laws: one is out of range", "[testing][sampler_laws]") {
  const Changed closed{[](Random& random) { return random.below(1000) == 0 ? 1.0F : random.uniform<float>(); }};
  CHECK(mentions(violations_of_sampler_laws(closed), "is not in [0, 1)"));
}

TEST_CASE("sampler_laws: a bent distribution is not uniform", "[testing][sampler_laws]") {
  const Changed bent{[](Random& random) {
    const float x = random.uniform<float>();
    return 0.5F * x + 0.5F * x * x;
  }};
  CHECK(mentions(violations_of_sampler_laws(bent), "samples: dimension 0 not uniform"));
}

TEST_CASE("sampler_laws: equal pixels are not uniform over the image", "[testing][sampler_laws]") {
  CHECK(mentions(violations_of_sampler_laws(EqualPixels{}), "pixels: dimension 0 not uniform"));
}

TEST_CASE("sampler_laws: neighbors with equal numbers correlate", "[testing][sampler_laws]") {
  CHECK(mentions(violations_of_sampler_laws(SlowPixels{}), "1 apart, correlate"));
}

TEST_CASE("sampler_laws: equal dimensions correlate", "[testing][sampler_laws]") {
  const auto violations = violations_of_sampler_laws(Repeating{});
  CHECK(mentions(violations, "samples: dimensions 0, 1 not uniform"));
  CHECK(mentions(violations, "samples: dimensions 0, 1, 0 apart, correlate"));
}

TEST_CASE("sampler_laws: hidden state is found out", "[testing][sampler_laws]") {
  Random random{3};
  CHECK(mentions(violations_of_sampler_laws(Impure{&random}), "differs when asked for again"));
}

TEST_CASE("sampler_laws: nets are told from what is even in each dimension alone", "[testing][sampler_laws]") {
  using glint::testing::violations_of_net_laws;
  CHECK(violations_of_net_laws(Net{}, {0, 0}).empty());
  // Turned by 1/4, the numbers y are still one in each interval, but two points of four share a quarter of the square.
  const auto turned = violations_of_net_laws(Net{0.25F}, {0, 0});
  CHECK(mentions(turned, "dimension 1: not one in each of 2^1 x 2^1 cells"));
  CHECK_FALSE(mentions(turned, "dimension 0"));
  CHECK(mentions(violations_of_net_laws(Changed{[](Random& random) { return random.uniform<float>(); }}, {0, 0}),
                 "dimension 0: not one in each of 2^8 x 2^0 cells"));
}

}  // namespace test_testing_sampler_laws
