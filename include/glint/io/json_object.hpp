// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <glint/color/rgb.hpp>
#include <glint/io/error.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Where JSON came from, and what was odd but not wrong about it.
struct JsonSource {
  std::filesystem::path path;
  std::vector<std::string> warnings{};
  bool strict = false;  ///< oddities are errors

  /// The whole is at no pointer.
  [[nodiscard]] IoError error(std::string_view pointer, std::string_view problem) const {
    return pointer.empty() ? IoError(path, problem) : IoError(path, pointer, problem);
  }

  /// Records something to know, which is wrong in no way.
  void note(std::string_view pointer, std::string_view remark) { warnings.emplace_back(error(pointer, remark).what()); }

  /// Records an oddity, or throws it where `strict`.
  void warn(std::string_view pointer, std::string_view problem) {
    if (strict) throw error(pointer, problem);
    note(pointer, problem);
  }
};

namespace detail {

/// The least number of inserted, deleted and exchanged letters between two words (Levenshtein 1966).
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t exchanged = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({exchanged, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// `; did you mean "eta"?` for the nearest of the known words, nothing where none is near.
[[nodiscard]] inline std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  if (nearest == known.end() || edit_distance(word, *nearest) > 1 + word.size() / 4) return {};
  return "; did you mean \"" + *nearest + "\"?";
}

/// The JSON pointer of a member. RFC 6901: ~ and / in keys are written ~0 and ~1.
[[nodiscard]] inline std::string child_pointer(const std::string& parent, std::string_view key) {
  std::string result = parent + "/";
  for (const char c : key) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c;
    }
  }
  return result;
}

/// "an object", "an array of 3", or the value itself: what a sentence says was found.
[[nodiscard]] inline std::string described(const nlohmann::json& value) {
  if (value.is_null()) return "null";
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  std::string text = value.dump();
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

}  // namespace detail

/// A JSON value and where it stands. Every question asked of it either has a valid answer or throws an IoError with
/// file, JSON pointer, what was found and what was expected.
class JsonValue {
 public:
  /// Requires: value and source outlive this.
  JsonValue(const nlohmann::json& value, std::string pointer, JsonSource& source)
      : value_(&value), pointer_(std::move(pointer)), source_(&source) {}

  [[nodiscard]] const nlohmann::json& json() const noexcept { return *value_; }
  [[nodiscard]] const std::string& pointer() const noexcept { return pointer_; }
  [[nodiscard]] JsonSource& source() const noexcept { return *source_; }

  [[noreturn]] void fail(std::string_view problem) const { throw source_->error(pointer_, problem); }
  [[noreturn]] void fail_expected(std::string_view expected) const {
    fail("found " + detail::described(*value_) + ", expected " + std::string(expected));
  }

  [[nodiscard]] float number() const {
    if (!value_->is_number()) fail_expected("a number");
    const double number = value_->get<double>();
    if (!(std::abs(number) <= std::numeric_limits<float>::max())) {
      fail_expected("a number that a 32-bit float can hold");
    }
    return static_cast<float>(number);
  }

  /// A number for which `accepts` holds.
  template <typename Predicate>
  [[nodiscard]] float number_where(Predicate&& accepts, std::string_view expected) const {
    if (!value_->is_number() || !accepts(number())) fail_expected(expected);
    return number();
  }

  /// An integer in [lowest, highest]; 32.0 is one too.
  [[nodiscard]] int integer(int lowest, int highest = std::numeric_limits<int>::max()) const {
    const std::string expected =
        "an integer from " + std::to_string(lowest) +
        (highest == std::numeric_limits<int>::max() ? " up" : " to " + std::to_string(highest));
    if (!value_->is_number()) fail_expected(expected);
    const double number = value_->get<double>();
    if (number != std::floor(number) || number < lowest || number > highest) fail_expected(expected);
    return static_cast<int>(number);
  }

  /// Any integer from 0 up that 64 bits can hold.
  [[nodiscard]] std::uint64_t seed() const {
    if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
    const double number = value_->is_number_float() ? value_->get<double>() : -1;
    if (!(number >= 0 && number < 0x1p64 && number == std::floor(number)))
      fail_expected("an integer from 0 to 2^64 - 1");
    return static_cast<std::uint64_t>(number);
  }

  [[nodiscard]] bool flag() const {
    if (!value_->is_boolean()) fail_expected("true or false");
    return value_->get<bool>();
  }

  [[nodiscard]] std::string text() const {
    if (!value_->is_string()) fail_expected("a string");
    return value_->get<std::string>();
  }

  [[nodiscard]] std::vector<JsonValue> items(std::string_view expected = "an array") const {
    if (!value_->is_array()) fail_expected(expected);
    std::vector<JsonValue> result;
    for (std::size_t i = 0; i < value_->size(); ++i) {
      result.emplace_back((*value_)[i], pointer_ + "/" + std::to_string(i), *source_);
    }
    return result;
  }

  /// Exactly n numbers.
  [[nodiscard]] std::vector<float> numbers(std::size_t n) const {
    const std::string expected = "an array of " + std::to_string(n) + " numbers";
    const std::vector<JsonValue> values = items(expected);
    if (values.size() != n) fail_expected(expected);
    std::vector<float> result;
    for (const JsonValue& value : values) result.push_back(value.number());
    return result;
  }

  [[nodiscard]] Vec2<float> vec2() const {
    const auto n = numbers(2);
    return {n[0], n[1]};
  }
  [[nodiscard]] Vec3<float> vec3() const {
    const auto n = numbers(3);
    return {n[0], n[1], n[2]};
  }
  /// Three numbers ≥ 0.
  [[nodiscard]] Rgb color() const {
    const auto n = numbers(3);
    if (n[0] < 0 || n[1] < 0 || n[2] < 0) fail("found " + value_->dump() + ", expected three numbers from 0 up");
    return {n[0], n[1], n[2]};
  }

 private:
  const nlohmann::json* value_;
  std::string pointer_;
  JsonSource* source_;
};

/// A JSON object that remembers which of its keys were asked for, so that `finish` can point at the others.
class JsonObject {
 public:
  /// Errors: IoError where the value is not an object.
  explicit JsonObject(JsonValue value) : value_(std::move(value)) {
    if (!value_.json().is_object()) value_.fail_expected("an object");
  }

  [[nodiscard]] const std::string& pointer() const noexcept { return value_.pointer(); }
  [[nodiscard]] JsonSource& source() const noexcept { return value_.source(); }
  [[noreturn]] void fail(std::string_view problem) const { value_.fail(problem); }

  [[nodiscard]] bool has(const std::string& key) const { return value_.json().contains(key); }

  /// The value at a key, if there is one.
  [[nodiscard]] std::optional<JsonValue> find(const std::string& key) {
    asked_.push_back(key);
    const auto found = value_.json().find(key);
    if (found == value_.json().end()) return std::nullopt;
    return JsonValue(*found, detail::child_pointer(pointer(), key), value_.source());
  }

  [[nodiscard]] JsonValue require(const std::string& key) {
    auto found = find(key);
    if (!found) fail("the key \"" + key + "\" is missing");
    return *std::move(found);
  }

  /// `read` of the value at a key, or the fallback where there is none.
  template <typename T, typename Read>
  [[nodiscard]] T read_or(const std::string& key, T fallback, Read&& read) {
    const auto found = find(key);
    return found ? T(read(*found)) : fallback;
  }
  [[nodiscard]] float number_or(const std::string& key, float fallback) {
    return read_or(key, fallback, [](const JsonValue& v) { return v.number(); });
  }
  [[nodiscard]] int integer_or(const std::string& key, int fallback, int lowest,
                               int highest = std::numeric_limits<int>::max()) {
    return read_or(key, fallback, [&](const JsonValue& v) { return v.integer(lowest, highest); });
  }
  [[nodiscard]] bool flag_or(const std::string& key, bool fallback) {
    return read_or(key, fallback, [](const JsonValue& v) { return v.flag(); });
  }
  [[nodiscard]] std::string text_or(const std::string& key, std::string fallback) {
    return read_or(key, std::move(fallback), [](const JsonValue& v) { return v.text(); });
  }
  [[nodiscard]] Vec2<float> vec2_or(const std::string& key, Vec2<float> fallback) {
    return read_or(key, fallback, [](const JsonValue& v) { return v.vec2(); });
  }
  [[nodiscard]] Vec3<float> vec3_or(const std::string& key, Vec3<float> fallback) {
    return read_or(key, fallback, [](const JsonValue& v) { return v.vec3(); });
  }
  [[nodiscard]] Rgb color_or(const std::string& key, Rgb fallback) {
    return read_or(key, fallback, [](const JsonValue& v) { return v.color(); });
  }
  [[nodiscard]] float positive_or(const std::string& key, float fallback) {
    return read_or(key, fallback, [](const JsonValue& v) {
      return v.number_where([](float number) { return number > 0; }, "a number above 0");
    });
  }
  [[nodiscard]] float not_negative_or(const std::string& key, float fallback) {
    return read_or(key, fallback, [](const JsonValue& v) {
      return v.number_where([](float number) { return number >= 0; }, "a number from 0 up");
    });
  }

  /// The items of the array at a key; none where there is no such key.
  [[nodiscard]] std::vector<JsonValue> items(const std::string& key) {
    const auto found = find(key);
    return found ? found->items() : std::vector<JsonValue>{};
  }

  /// All members, each of them asked for.
  [[nodiscard]] std::vector<std::pair<std::string, JsonValue>> members() {
    std::vector<std::pair<std::string, JsonValue>> result;
    for (const auto& [key, value] : value_.json().items()) {
      asked_.push_back(key);
      result.emplace_back(key, JsonValue(value, detail::child_pointer(pointer(), key), value_.source()));
    }
    return result;
  }

  /// Keys that mean something elsewhere, or nothing on purpose: no cause for a warning.
  void ignore(std::initializer_list<const char*> keys) { asked_.insert(asked_.end(), keys.begin(), keys.end()); }

  /// Warns of keys that nobody asked for.
  void finish() {
    for (const auto& [key, value] : value_.json().items()) {
      if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
      value_.source().warn(detail::child_pointer(pointer(), key), "unknown key" + detail::suggestion(key, asked_));
    }
  }

 private:
  JsonValue value_;
  std::vector<std::string> asked_;
};

}  // namespace glint
