// SPDX-License-Identifier: MIT
#include <glint/film/splats.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <support/catch.hpp>

#include <glint/film/film.hpp>

namespace test_film_splats {

using glint::Rgb;
using glint::Splats;

TEST_CASE("splats: the sum has the same bits in every order, and is right to the last digits", "[film][splats]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-20, 20);
  std::vector<float> values(1000);
  for (float& value : values) value = std::exp2(exponent(random));
  double exact = 0;  // within 10³ roundings of 2⁻⁵³
  for (const float value : values) exact += static_cast<double>(value);
  Splats forward({2, 3});
  for (const float value : values) CHECK(forward.add({1, 2}, Rgb{value, 2 * value, 0}));
  std::reverse(values.begin(), values.end());
  Splats backward({2, 3});
  for (const float value : values) CHECK(backward.add({1, 2}, Rgb{value, 2 * value, 0}));
  CHECK(forward.sum({1, 2}, 1) == backward.sum({1, 2}, 1));
  CHECK(forward.sum({1, 2}, 1).r == static_cast<float>(exact));
  CHECK(forward.sum({1, 2}, 0.5).g == static_cast<float>(exact));
  CHECK(forward.sum({0, 2}, 1) == Rgb{0});
}

TEST_CASE("splats: faint light and bright light keep their digits", "[film][splats]") {
  Splats splats({1, 1});
  splats.add({0, 0}, Rgb{1e-9F, 1e9F, -3});
  const Rgb sum = splats.sum({0, 0}, 1);
  CHECK(sum.r == Approx(1e-9).epsilon(1e-5));  // units of 2⁻⁴⁸ = 3.6e-15
  CHECK(sum.g == 1e9F);
  CHECK(sum.b == -3);
}

TEST_CASE("splats: what is not finite or too much is left out", "[film][splats]") {
  Splats splats({1, 1});
  CHECK_FALSE(splats.add({0, 0}, Rgb{1, std::numeric_limits<float>::quiet_NaN(), 1}));
  CHECK_FALSE(splats.add({0, 0}, Rgb{1, 1, std::numeric_limits<float>::infinity()}));
  CHECK_FALSE(splats.add({0, 0}, Rgb{Splats::limit, 1, 1}));
  CHECK(splats.sum({0, 0}, 1) == Rgb{0});
  CHECK(Splats{}.empty());
}

TEST_CASE("splats: a film shows their mean over paths beside its samples, until it is cleared", "[film][splats]") {
  glint::Film film{{4, 2}};
  film.block(0).add({2.5F, 1.5F}, Rgb{3});
  film.splats().add({2, 1}, Rgb{1});
  film.splats().add({2, 1}, Rgb{2});
  film.count_splatting_paths(16);            // two for each of 8 pixels
  CHECK(film.develop()(2, 1) == Rgb{4.5F});  // 3 + (1 + 2) / 2
  CHECK(film.develop()(0, 0) == Rgb{0});
  film.clear();
  CHECK(film.develop()(2, 1) == Rgb{0});
}

}  // namespace test_film_splats
