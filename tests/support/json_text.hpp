// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include <glint/io/json_object.hpp>

#include <support/temporary_directory.hpp>

namespace glint::testing {

/// JSON that pretends to stand in a file `scene.json`, at a pointer.
struct JsonText {
  nlohmann::json json;
  JsonSource source{.path = "scene.json"};

  explicit JsonText(std::string_view text) : json(nlohmann::json::parse(text)) {}

  [[nodiscard]] JsonValue value(std::string pointer = "") { return {json, std::move(pointer), source}; }
  [[nodiscard]] JsonObject object(std::string pointer = "") { return JsonObject(value(std::move(pointer))); }
};

/// What `read(object)` throws of a text that stands at /x, without the `scene.json:` before it.
template <typename Read>
[[nodiscard]] std::string json_error(std::string_view text, Read&& read) {
  JsonText json(text);
  return message_of<IoError>([&] { (void)read(json.object("/x")); }, "scene.json:");
}

}  // namespace glint::testing
