// SPDX-License-Identifier: MIT
#include <glint/film/filter.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include <glint/core/one_of.hpp>

#include <support/catch.hpp>
#include <support/shared.hpp>

namespace test_film_filter {

namespace {

using glint::BoxFilter;
using glint::GaussianFilter;
using glint::MitchellFilter;
using glint::TentFilter;

}  // namespace

TEST_CASE("filter: the box is one in a closed square", "[film][filter]") {
  CHECK(BoxFilter{}.evaluate({0.5F, -0.5F}) == 1);
  CHECK(BoxFilter{}.evaluate({0.51F, 0}) == 0);
  CHECK(BoxFilter{2}.evaluate({-2, 1}) == 1);
  CHECK(BoxFilter{2}.evaluate({0, 2.001F}) == 0);
}

TEST_CASE("filter: the tent falls linearly to zero", "[film][filter]") {
  CHECK(TentFilter{2}.evaluate({0, 0}) == 1);
  CHECK(TentFilter{2}.evaluate({1, 0}) == 0.5F);
  CHECK(TentFilter{2}.evaluate({-1, 1.5F}) == 0.125F);  // ½ · ¼
  CHECK(TentFilter{2}.evaluate({2, 0}) == 0);
  CHECK(TentFilter{2}.evaluate({3, 3}) == 0);  // not the product of two negative heights
}

TEST_CASE("filter: the gaussian ends at zero", "[film][filter]") {
  const GaussianFilter filter{.radius = 1.5F, .alpha = 1};
  CHECK(filter.evaluate({0, 0}) == Approx(std::pow(1 - std::exp(-2.25), 2)));
  CHECK(filter.evaluate({1, 0}) == Approx((std::exp(-1) - std::exp(-2.25)) * (1 - std::exp(-2.25))));
  CHECK(filter.evaluate({1.5F, 0}) == 0);
  CHECK(filter.evaluate({1.6F, -1.6F}) == 0);
}

TEST_CASE("filter: a mitchell filter shifted by pixels adds up to one", "[film][filter]") {
  // Every member of the family keeps constants: Σ over integers k of m(x − k) = 1 (at radius 2).
  const float b = GENERATE(0.0F, 1.0F / 3, 1.0F);
  const float c = GENERATE(0.0F, 1.0F / 3, 0.5F);
  const auto profile = MitchellFilter{.radius = 2, .b = b, .c = c}.profile();
  for (int i = 0; i <= 16; ++i) {
    const float x = static_cast<float>(i) / 16;
    CHECK(profile(x - 2) + profile(x - 1) + profile(x) + profile(x + 1) == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("filter: a mitchell filter is smooth and stretches with its radius", "[film][filter]") {
  const auto profile = MitchellFilter{.b = 0.4F, .c = 0.3F}.profile();
  CHECK(profile(1) == Approx(0.4F / 6));  // B / 6 from both pieces
  CHECK(profile(1 + 1e-6F) == Approx(profile(1 - 1e-6F)).epsilon(1e-4));
  CHECK(profile(2) == 0);
  CHECK(profile(-2.5F) == 0);
  const auto narrow = MitchellFilter{.radius = 0.5F, .b = 0.4F, .c = 0.3F}.profile();
  for (const float x : {0.0F, 0.7F, 1.25F, 1.9F}) CHECK(narrow(x / 4) == Approx(profile(x)).margin(1e-7));
}

TEMPLATE_TEST_CASE("filter: evaluation is the product of the profile, even in both axes", "[film][filter]", BoxFilter,
                   TentFilter, GaussianFilter, MitchellFilter) {
  const TestType filter{};
  const auto profile = filter.profile();
  for (int i = 0; i < 100; ++i) {
    const float x = 0.05F * static_cast<float>(i % 10) - 0.2F;
    const float y = 0.3F * static_cast<float>(i / 10) - 1.5F;
    CHECK(filter.evaluate({x, y}) == Approx(profile(x) * profile(y)).margin(1e-7));  // compilers may fuse differently
    CHECK(filter.evaluate({x, y}) == Approx(filter.evaluate({-x, -y})).margin(1e-7));
  }
  CHECK(filter.evaluate({filter.radius * 1.001F, 0}) == 0);
}

TEST_CASE("filter: the radius of a choice is that of the filter chosen", "[film][filter]") {
  using Any = glint::OneOf<BoxFilter, TentFilter, GaussianFilter, MitchellFilter>;
  STATIC_REQUIRE(glint::Filter<Any>);
  CHECK(glint::filter_radius(Any{GaussianFilter{.radius = 3}}) == 3);
  CHECK(glint::filter_radius(TentFilter{.radius = 2}) == 2);
}

TEST_CASE("filter: agrees with the scene format", "[film][filter][vectors]") {
  const auto text = glint::testing::shared_file("vectors/filters.json");
  if (!text) return;
  const auto vectors = nlohmann::json::parse(*text);
  const auto number = [](const nlohmann::json& at, const char* key) { return at.at(key).get<float>(); };
  const auto check = [&](const nlohmann::json& expected, const auto& filter) {
    CAPTURE(expected.dump());
    const float weight = filter.evaluate({number(expected, "x"), number(expected, "y")});
    CHECK(weight == Approx(number(expected, "w")).margin(1e-6));
  };
  for (const auto& v : vectors.at("box")) check(v, BoxFilter{number(v, "radius")});
  for (const auto& v : vectors.at("gaussian")) check(v, GaussianFilter{number(v, "radius"), number(v, "alpha")});
  for (const auto& v : vectors.at("mitchell")) {
    check(v, MitchellFilter{number(v, "radius"), number(v, "B"), number(v, "C")});
  }
}

}  // namespace test_film_filter
