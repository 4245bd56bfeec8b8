// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <glint/io/error.hpp>
#include <glint/io/json_object.hpp>

namespace glint {

namespace detail {

/// Turns the parser's events into a value. Keeps what the parser's own builder loses: where a number is out of range,
/// and keys that come twice.
class JsonBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  /// Deeper nesting than any scene's; values are copied and described by recursion.
  static constexpr std::size_t max_depth = 64;

  JsonBuilder(const std::string& text, JsonSource& source) : text_(text), source_(source) {}

  [[nodiscard]] nlohmann::json take() && { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }  // no JSON text has any

  bool start_object(std::size_t /*size*/) override { return open(nlohmann::json::object()); }
  bool start_array(std::size_t /*size*/) override { return open(nlohmann::json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    Level& level = levels_.back();
    level.key = key;
    if (level.container->contains(key)) {
      source_.warn(pointer(), "the key comes twice, and only its last value counts");
    }
    return true;
  }

  /// Errors: IoError, always.
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::json::exception& error) override {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
    const auto line = 1 + std::count(text_.begin(), end, '\n');
    std::string reason = error.what();
    for (const char* const start : {"syntax error", "number overflow"}) {
      if (const auto found = reason.find(start); found != std::string::npos) reason.erase(0, found);
    }
    if (reason.size() > 200) reason = reason.substr(0, 197) + "...";
    throw IoError(source_.path, static_cast<std::size_t>(line), "is not JSON: " + reason);
  }

 private:
  struct Level {
    nlohmann::json* container;
    std::string key;  // of the member at hand
  };

  [[nodiscard]] nlohmann::json* place(nlohmann::json value) {
    if (levels_.empty()) return &(root_ = std::move(value));
    nlohmann::json& container = *levels_.back().container;
    if (container.is_object()) return &(container[levels_.back().key] = std::move(value));
    container.push_back(std::move(value));
    return &container.back();
  }
  bool add(nlohmann::json value) { return place(std::move(value)) != nullptr; }

  bool open(nlohmann::json container) {
    if (levels_.size() == max_depth) {
      throw IoError(source_.path, "is nested too deeply, expected at most " + std::to_string(max_depth) + " levels");
    }
    levels_.push_back({place(std::move(container)), {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  [[nodiscard]] std::string pointer() const {
    std::string result;
    for (const Level& level : levels_) {
      result =
          child_pointer(result, level.container->is_object() ? level.key : std::to_string(level.container->size() - 1));
    }
    return result;
  }

  const std::string& text_;
  JsonSource& source_;
  nlohmann::json root_;
  std::vector<Level> levels_;
};

}  // namespace detail

/// JSON from text. A key that comes twice in an object is a warning of the source; a byte order mark is passed over.
///
/// Errors:   IoError with the line where the text is not JSON, has a number beyond doubles, or is nested too deeply.
[[nodiscard]] inline nlohmann::json parse_json(const std::string& text, JsonSource& source) {
  detail::JsonBuilder builder(text, source);
  nlohmann::json::sax_parse(text, &builder);
  return std::move(builder).take();
}

/// Merges `source` into `target`: objects key by key; everything else, arrays included, replaced.
inline void merge_json(nlohmann::json& target, const nlohmann::json& source) {
  if (!target.is_object() || !source.is_object()) {
    target = source;
    return;
  }
  for (const auto& [key, value] : source.items()) merge_json(target[key], value);
}

}  // namespace glint
