// SPDX-License-Identifier: MIT
#include <glint/core/one_of.hpp>  // first, so the header proves it stands alone

#include <string>
#include <type_traits>

#include <support/catch.hpp>

namespace test_core_one_of {

namespace {

struct Scale {
  float factor = 2.0F;
  [[nodiscard]] float evaluate(float x) const { return factor * x; }
  [[nodiscard]] static bool is_specular() { return false; }
  [[nodiscard]] int rays() const { return 7; }
  [[nodiscard]] friend bool operator==(const Scale&, const Scale&) = default;
};

struct Shift {
  float offset = 3.0F;
  [[nodiscard]] float evaluate(float x) const { return offset + x; }
  [[nodiscard]] static bool is_specular() { return true; }
  [[nodiscard]] std::string rays() const { return "seven"; }
  [[nodiscard]] friend bool operator==(const Shift&, const Shift&) = default;
};

struct Silent {};

using Either = glint::OneOf<Scale, Shift>;

template <typename T>
concept CanEvaluate = requires(const T& x) {
  x.evaluate(1.0F);
};

}  // namespace

TEST_CASE("one of: forwards a call to the value it holds", "[core][one_of]") {
  CHECK(Either{Scale{}}.evaluate(5.0F) == 10.0F);
  CHECK(Either{Shift{}}.evaluate(5.0F) == 8.0F);
  CHECK_FALSE(Either{Scale{}}.is_specular());
  CHECK(Either{Shift{}}.is_specular());
}

TEST_CASE("one of: holds its first type by default", "[core][one_of]") {
  CHECK(Either{} == Either{Scale{}});
}

TEST_CASE("one of: values are equal when both type and value are", "[core][one_of]") {
  CHECK(Either{Scale{4.0F}} == Either{Scale{4.0F}});
  CHECK(Either{Scale{4.0F}} != Either{Scale{5.0F}});
  CHECK(Either{Scale{4.0F}} != Either{Shift{4.0F}});
}

TEST_CASE("one of: shows its value as the type it has, and as no other", "[core][one_of]") {
  const Either value{Shift{9.0F}};
  REQUIRE(value.get_if<Shift>() != nullptr);
  CHECK(value.get_if<Shift>()->offset == 9.0F);
  CHECK(value.get_if<Scale>() == nullptr);
}

TEST_CASE("one of: a call that not every type answers does not exist", "[core][one_of]") {
  STATIC_REQUIRE(CanEvaluate<Either>);
  STATIC_REQUIRE_FALSE(CanEvaluate<glint::OneOf<Scale, Silent>>);
}

TEST_CASE("one of: takes the listed types alone, without conversions", "[core][one_of]") {
  using Number = glint::OneOf<int, double>;
  STATIC_REQUIRE(std::is_constructible_v<Number, int>);
  STATIC_REQUIRE_FALSE(std::is_constructible_v<Number, float>);
  STATIC_REQUIRE_FALSE(std::is_constructible_v<Number, char>);
}

TEST_CASE("one of: answers of different types come back as one of those types", "[core][one_of]") {
  using Answer = glint::OneOf<int, std::string>;
  STATIC_REQUIRE(std::is_same_v<decltype(Either{}.rays()), Answer>);
  CHECK(Either{Scale{}}.rays() == Answer{7});
  CHECK(Either{Shift{}}.rays() == Answer{std::string("seven")});
}

TEST_CASE("one of: answers of one type come back as that type", "[core][one_of]") {
  const auto twice = [](const auto& x) { return 2.0F * x.evaluate(1.0F); };
  STATIC_REQUIRE(std::is_same_v<decltype(Either{}.transform(twice)), float>);
  CHECK(Either{Shift{}}.transform(twice) == 8.0F);
}

TEST_CASE("one of: visits the value itself, to change it too", "[core][one_of]") {
  Either value{Scale{}};
  value.visit([](auto& x) {
    if constexpr (std::is_same_v<decltype(x), Scale&>) x.factor = 10.0F;
  });
  CHECK(value.evaluate(1.0F) == 10.0F);
}

TEST_CASE("one of: the last of several types is found as the first is", "[core][one_of]") {
  using Many = glint::OneOf<int, char, long, Silent, Scale>;
  const auto is_scale = [](const auto& x) { return std::is_same_v<std::remove_cvref_t<decltype(x)>, Scale>; };
  CHECK(Many{Scale{}}.visit(is_scale));
  CHECK_FALSE(Many{Silent{}}.visit(is_scale));
  CHECK_FALSE(Many{1}.visit(is_scale));
}

}  // namespace test_core_one_of
