// SPDX-License-Identifier: MIT
#include <glint/color/compare.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>

namespace test_color_compare {

using glint::Image;
using glint::Rgb;

TEST_CASE("compare: an image does not differ from itself", "[color][compare]") {
  Image image({3, 2}, {0.5F, 2, 1e-4F});
  image(1, 1) = {-1, 0, 100};
  CHECK(compare(image, image) == glint::ImageDifference{});
  CHECK(compare(Image({3, 2}), Image({3, 2})) == glint::ImageDifference{});
  CHECK(compare(Image{}, Image{}) == glint::ImageDifference{});
}

TEST_CASE("compare: images of different size have no difference", "[color][compare]") {
  CHECK_FALSE(compare(Image({3, 2}), Image({2, 3})));
}

TEST_CASE("compare: one pixel off shows in every figure as defined", "[color][compare]") {
  const Image reference({2, 2}, 0.5F);
  Image image = reference;
  image(1, 0) = {1, 0.5F, 0.25F};  // gaps ½, 0, ¼
  const auto difference = compare(image, reference);
  REQUIRE(difference);
  CHECK(difference->mean_ratio == Approx((6 + 0.5 - 0.25) / 6));  // twelve channels of ½
  CHECK(difference->mse == Approx((0.25 + 0.0625) / 12));
  CHECK(difference->rmse == Approx(std::sqrt(0.3125 / 12)));
  CHECK(difference->relmse == Approx((0.25 + 0.0625) / (0.25 + 0.01) / 12));
  CHECK(difference->share_above == 0.25);
  CHECK(difference->max_abs == 0.5);
}

TEST_CASE("compare: relmse is relative to the second image", "[color][compare]") {
  const auto difference = compare(Image({1, 1}, 1), Image({1, 1}, 3));
  REQUIRE(difference);
  CHECK(difference->relmse == Approx(4 / 9.01));
}

TEST_CASE("compare: gaps up to 0.01 do not count as off", "[color][compare]") {
  Image image({2, 1}, 0);
  image(0, 0) = {0, 0, 0.0099F};
  image(1, 0) = {0, 0, -0.0101F};
  CHECK(compare(image, Image({2, 1}))->share_above == 0.5);
}

TEST_CASE("compare: a broken image never looks good", "[color][compare]") {
  const float bad = GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity());
  const bool both = GENERATE(false, true);
  Image reference({4, 1}, 1);
  Image image = reference;
  image(2, 0).g = bad;
  if (both) reference(2, 0).g = bad;
  const auto difference = compare(image, reference);
  REQUIRE(difference);
  CHECK_FALSE(difference->mse < 1e9);
  CHECK_FALSE(difference->rmse < 1e9);
  CHECK_FALSE(difference->relmse < 1e9);
  CHECK(difference->share_above == 0.25);
  CHECK(std::isinf(difference->max_abs));
  CHECK_FALSE(compare(reference, image)->mse < 1e9);
  CHECK_FALSE(compare(reference, image)->relmse < 1e9);
}

}  // namespace test_color_compare
