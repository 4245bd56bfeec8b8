// SPDX-License-Identifier: MIT
#include <glint/texture/checkerboard.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <nlohmann/json.hpp>

#include <support/catch.hpp>
#include <support/shared.hpp>

namespace test_texture_checkerboard {

namespace {

constexpr glint::Checkerboard board{.color0 = 0, .color1 = 1};

}  // namespace

TEST_CASE("checkerboard: a unit holds two squares by two", "[texture][checkerboard]") {
  CHECK(board.evaluate({0.25F, 0.25F}) == glint::Rgb{0});
  CHECK(board.evaluate({0.75F, 0.25F}) == glint::Rgb{1});
  CHECK(board.evaluate({0.25F, 0.75F}) == glint::Rgb{1});
  CHECK(board.evaluate({0.75F, 0.75F}) == glint::Rgb{0});
  CHECK(board.evaluate({0.5F, 0}) == glint::Rgb{1});  // a border belongs to the square that begins there
}

TEST_CASE("checkerboard: the squares at an axis are twice as wide", "[texture][checkerboard]") {
  CHECK(board.evaluate({-0.25F, 0.25F}) == board.evaluate({0.25F, 0.25F}));
  CHECK(board.evaluate({-0.75F, 0.25F}) == board.evaluate({0.75F, 0.25F}));
}

TEST_CASE("checkerboard: a mapping applies first", "[texture][checkerboard]") {
  const glint::Checkerboard fine{.color0 = 0, .color1 = 1, .mapping = {.scale = {4, 4}, .delta = {0.5F, 0}}};
  CHECK(fine.evaluate({0, 0}) == glint::Rgb{1});          // s = ½
  CHECK(fine.evaluate({0.125F, 0}) == glint::Rgb{0});     // s = 1
  CHECK(fine.evaluate({0.125F, 0.2F}) == glint::Rgb{1});  // t = 0.8
}

TEST_CASE("checkerboard: has a color far away and where coordinates are no numbers", "[texture][checkerboard]") {
  const float far = GENERATE(0x1p31F, -0x1p40F, std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::max());
  CHECK(board.evaluate({far, 0.25F}) == glint::Rgb{0});
  CHECK(board.evaluate({0.75F, far}) == glint::Rgb{1});
  CHECK(board.evaluate({0x1p23F + 1, 0.25F}) == glint::Rgb{0});  // 2s even
}

TEST_CASE("checkerboard: agrees with the scene format", "[texture][checkerboard][vectors]") {
  const auto text = glint::testing::shared_file("vectors/checkerboard.json");
  if (!text) return;
  const auto vectors = nlohmann::json::parse(*text);
  for (const auto& expected : vectors.at("cases")) {
    CAPTURE(expected.dump());
    const auto& st = expected.at("st");
    CHECK(board.evaluate({st.at(0).get<float>(), st.at(1).get<float>()}) ==
          glint::Rgb{expected.at("color").get<float>()});
  }
}

}  // namespace test_texture_checkerboard
