// SPDX-License-Identifier: MIT
#include <glint/core/one_of.hpp>  // first, so the header proves it stands alone

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

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

TEST_CASE("one of: is copied as bytes where all its types are", "[core][one_of]") {
  STATIC_REQUIRE(std::is_trivially_copyable_v<Either>);
  STATIC_REQUIRE(std::is_trivially_destructible_v<Either>);
  STATIC_REQUIRE_FALSE(std::is_trivially_copyable_v<glint::OneOf<Scale, std::string>>);
}

TEST_CASE("one of: has room and alignment for each of its types, and no more than a word beside", "[core][one_of]") {
  struct alignas(32) Wide {
    std::array<char, 64> bytes;
  };
  using Mixed = glint::OneOf<char, Wide, double>;
  STATIC_REQUIRE(alignof(Mixed) == 32);
  STATIC_REQUIRE(sizeof(Mixed) == 64 + 32);
  STATIC_REQUIRE(sizeof(Either) == 2 * sizeof(float));
}

TEST_CASE("one of: copies its value, which is then another", "[core][one_of]") {
  using Word = glint::OneOf<std::string, std::vector<int>, int>;
  const Word first{std::vector<int>{1, 2, 3}};
  Word second = first;
  second.visit([](auto& x) {
    if constexpr (std::is_same_v<decltype(x), std::vector<int>&>) x.push_back(4);
  });
  CHECK(*first.get_if<std::vector<int>>() == std::vector<int>{1, 2, 3});
  CHECK(*second.get_if<std::vector<int>>() == std::vector<int>{1, 2, 3, 4});
  second = Word{std::string("a text too long to be kept inside of the string object itself")};
  second = first;
  CHECK(second == first);
  const Word& itself = second;
  second = itself;
  CHECK(second == first);
}

TEST_CASE("one of: moves its value along", "[core][one_of]") {
  using Owner = glint::OneOf<int, std::unique_ptr<int>>;
  STATIC_REQUIRE_FALSE(std::is_copy_constructible_v<Owner>);
  auto owned = std::make_unique<int>(7);
  const int* const address = owned.get();
  Owner first{std::move(owned)};
  Owner second{1};
  second = std::move(first);
  REQUIRE(second.get_if<std::unique_ptr<int>>() != nullptr);
  CHECK(second.get_if<std::unique_ptr<int>>()->get() == address);
  const Owner third = std::move(second);
  CHECK(third.get_if<std::unique_ptr<int>>()->get() == address);
}

TEST_CASE("one of: destroys each value once", "[core][one_of]") {
  using Shared = glint::OneOf<int, std::shared_ptr<int>, std::string>;
  const auto watched = std::make_shared<int>(7);
  {
    Shared first{watched};
    Shared second = first;
    CHECK(watched.use_count() == 3);
    second = Shared{std::string("another")};
    CHECK(watched.use_count() == 2);
    second = first;
    first = second;
    CHECK(watched.use_count() == 3);
    second = std::move(first);
    CHECK(watched.use_count() == 2);
    const std::vector<Shared> several(5, second);
    CHECK(watched.use_count() == 7);
  }
  CHECK(watched.use_count() == 1);
}

}  // namespace test_core_one_of
