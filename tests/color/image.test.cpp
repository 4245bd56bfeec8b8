// SPDX-License-Identifier: MIT
#include <glint/color/image.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_color_image {

using glint::Image;
using glint::Rgb;

TEST_CASE("image: begins black, or filled", "[color][image]") {
  CHECK(Image({2, 3}).pixels() == std::vector<Rgb>(6));
  CHECK(Image({2, 1}, {1, 2, 3}).pixels() == std::vector<Rgb>{{1, 2, 3}, {1, 2, 3}});
}

TEST_CASE("image: pixels lie row by row from the top", "[color][image]") {
  Image image({3, 2});
  image(2, 0) = 1;
  image(0, 1) = 2;
  CHECK(image.pixels()[2] == Rgb{1});
  CHECK(image.pixels()[3] == Rgb{2});
  CHECK(image.size() == glint::Vec2i(3, 2));
  CHECK((image.width() == 3 && image.height() == 2));
}

TEST_CASE("image: is empty where a side is zero", "[color][image]") {
  CHECK(Image{}.empty());
  CHECK(Image({0, 5}).empty());
  CHECK_FALSE(Image({1, 1}).empty());
}

TEST_CASE("image: equal images have equal sizes and pixels", "[color][image]") {
  CHECK(Image({2, 3}, 1) == Image({2, 3}, 1));
  CHECK_FALSE(Image({2, 3}, 1) == Image({3, 2}, 1));
  CHECK_FALSE(Image({2, 3}, 1) == Image({2, 3}, 2));
}

}  // namespace test_color_image
