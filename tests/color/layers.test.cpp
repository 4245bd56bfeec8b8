// SPDX-License-Identifier: MIT
#include <glint/color/layers.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <string>
#include <vector>

#include <support/catch.hpp>

namespace test_color_layers {

namespace {

using glint::Image;
using glint::image_of;
using glint::Layers;
using glint::Rgb;

using Floats = std::vector<float>;
using Integers = std::vector<std::uint32_t>;

/// One row of two pixels.
const Layers layers{{2, 1},
                    {{"B", Floats{3, 6}},
                     {"G", Floats{2, 5}},
                     {"R", Floats{1, 4}},
                     {"A", Floats{0, 0}},
                     {"N.Z", Floats{9, 9}},
                     {"N.X", Floats{7, 7}},
                     {"N.Y", Floats{8, 8}},
                     {"uv.U", Floats{0.5F, 0.25F}},
                     {"uv.V", Floats{0.75F, 1}},
                     {"id", Integers{3, 4'294'967'295U}},
                     {"left.eye.G", Floats{1, 2}},
                     {"left.eye.R", Floats{3, 4}}}};

Image row(const Rgb& first, const Rgb& second) {
  Image image{{2, 1}};
  image(0, 0) = first;
  image(1, 0) = second;
  return image;
}

}  // namespace

TEST_CASE("layers: a channel belongs to the layer before its last dot, or is one", "[color][layers]") {
  CHECK(glint::layer_of("R").empty());
  CHECK(glint::layer_of("A").empty());
  CHECK(glint::layer_of("Z") == "Z");
  CHECK(glint::layer_of("albedo.R") == "albedo");
  CHECK(glint::layer_of("left.eye.R") == "left.eye");
  CHECK(glint::layer_names(layers) == std::vector<std::string>{"", "N", "uv", "id", "left.eye"});
}

TEST_CASE("layers: as colors, whatever their channels are called", "[color][layers]") {
  CHECK(image_of(layers, "") == row({1, 2, 3}, {4, 5, 6}));
  CHECK(image_of(layers, "N") == row({7, 8, 9}, {7, 8, 9}));
  CHECK(image_of(layers, "uv") == row({0.5F, 0.75F, 0}, {0.25F, 1, 0}));
  CHECK(image_of(layers, "id") == row(Rgb{3}, Rgb{4'294'967'296.0F}));  // the nearest float
  CHECK(image_of(layers, "left.eye") == row({3, 1, 0}, {4, 2, 0}));
  CHECK_FALSE(image_of(layers, "left"));
  CHECK_FALSE(image_of(layers, "R"));
}

TEST_CASE("layers: an image that was added comes back", "[color][layers]") {
  const Image picture = row({0.1F, 0.2F, 0.3F}, {4, 5, 6});
  Layers made{{2, 1}};
  add_image(made, picture);
  add_image(made, row(Rgb{1}, Rgb{2}), "albedo");
  CHECK(image_of(made, "") == picture);
  CHECK(image_of(made, "albedo") == row(Rgb{1}, Rgb{2}));
  REQUIRE(find_channel(made, "albedo.G") != nullptr);
  CHECK(find_channel(made, "albedo.G")->at(1) == 2);
  CHECK(find_channel(made, "albedo") == nullptr);
}

}  // namespace test_color_layers
