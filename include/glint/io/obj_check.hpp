// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <glint/io/error.hpp>

namespace glint::detail {

/// Reads through an OBJ file and refuses what its parser would take silently for something else.
class ObjCheck {
 public:
  explicit ObjCheck(const std::filesystem::path& path) : path_(path) {}

  /// The number of corners of each face, in the file's order.
  ///
  /// Errors:   IoError with the line of the first mistake.
  [[nodiscard]] std::vector<std::uint32_t> corner_counts(std::string_view text) {
    while (!text.empty()) {
      std::string_view line = take_until(text, '\n');
      if (line.ends_with('\r')) line.remove_suffix(1);
      do {
        ++line_;
        check_line(take_until(line, '\r'));
      } while (!line.empty());
    }
    for (const Reference& reference : forward_) {
      const std::size_t count = counts_[reference.kind];
      if (reference.index <= count) continue;
      throw IoError(path_, reference.line,
                    "face refers to " + named(reference.kind, reference.index) + ", but the file has " +
                        counted(count, reference.kind));
    }
    if (corner_counts_.empty()) throw IoError(path_, "has no faces, expected a mesh");
    return std::move(corner_counts_);
  }

 private:
  enum Kind : std::size_t { Vertex, TextureCoordinate, Normal };
  struct Reference {
    std::size_t line;
    Kind kind;
    std::size_t index;
  };

  static constexpr std::string_view blank = " \t";

  [[nodiscard]] static std::string named(Kind kind, std::size_t index) {
    constexpr std::array names{"vertex ", "texture coordinate ", "normal "};
    return names[kind] + std::to_string(index);
  }
  [[nodiscard]] static std::string counted(std::size_t count, Kind kind) {
    constexpr std::array one{" vertex", " texture coordinate", " normal"};
    constexpr std::array many{" vertices", " texture coordinates", " normals"};
    return std::to_string(count) + (count == 1 ? one[kind] : many[kind]);
  }
  [[noreturn]] void fail(const std::string& problem) const { throw IoError(path_, line_, problem); }

  [[nodiscard]] static std::string_view take_until(std::string_view& text, char end) noexcept {
    const std::string_view taken = text.substr(0, text.find(end));
    text.remove_prefix(std::min(taken.size() + 1, text.size()));
    return taken;
  }

  /// The next word of a line, empty at its end.
  [[nodiscard]] static std::string_view take_word(std::string_view& line) noexcept {
    line.remove_prefix(std::min(line.find_first_not_of(blank), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(blank));
    line.remove_prefix(word.size());
    return word;
  }

  void check_line(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword == "v") {
      check_numbers(line, "vertex", 3);
      ++counts_[Vertex];
    } else if (keyword == "vn") {
      check_numbers(line, "normal", 3);
      ++counts_[Normal];
    } else if (keyword == "vt") {
      check_numbers(line, "texture coordinate", 1);
      ++counts_[TextureCoordinate];
    } else if (keyword == "f") {
      check_face(line);
    }
  }

  void check_numbers(std::string_view line, std::string_view what, std::size_t least) const {
    std::size_t found = 0;
    for (std::string_view word = take_word(line); !word.empty() && word[0] != '#'; word = take_word(line), ++found) {
      check_number(word, what);
    }
    if (found >= least) return;
    fail(std::string(what) + " has " + std::to_string(found) + (found == 1 ? " number" : " numbers") + ", expected " +
         std::to_string(least));
  }

  void check_number(std::string_view word, std::string_view what) const {
    const std::string_view digits = word.substr(word.starts_with('+') && !word.starts_with("+-") ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) {
      fail(std::string(what) + " has \"" + std::string(word) + "\", expected a number");
    }
    if (error == std::errc{} && std::abs(value) <= std::numeric_limits<float>::max()) return;
    const auto exponent = digits.substr(std::min(digits.find_first_of("eE"), digits.size() - 1) + 1);
    if (error == std::errc::result_out_of_range && exponent.starts_with('-')) return;  // rounds to zero
    fail(std::string(what) + " has " + std::string(word) + ", expected a finite number");
  }

  void check_face(std::string_view line) {
    std::uint32_t corners = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++corners) check_corner(word);
    if (corners < 3) {
      fail("face has " + std::to_string(corners) + (corners == 1 ? " corner" : " corners") + ", expected at least 3");
    }
    corner_counts_.push_back(corners);
  }

  /// v, v/vt, v//vn or v/vt/vn.
  void check_corner(std::string_view word) {
    std::string_view rest = word;
    check_index(word, rest, Vertex);
    if (!skip_slash(rest)) return require_end(word, rest);
    if (!skip_slash(rest)) {
      check_index(word, rest, TextureCoordinate);
      if (!skip_slash(rest)) return require_end(word, rest);
    }
    check_index(word, rest, Normal);
    require_end(word, rest);
  }

  [[nodiscard]] static bool skip_slash(std::string_view& rest) noexcept {
    if (!rest.starts_with('/')) return false;
    rest.remove_prefix(1);
    return true;
  }

  void require_end(std::string_view word, std::string_view rest) const {
    if (!rest.empty()) bad_corner(word);
  }
  [[noreturn]] void bad_corner(std::string_view word) const {
    fail("face corner \"" + std::string(word) + "\" is not of the form v, v/vt, v//vn or v/vt/vn");
  }

  void check_index(std::string_view word, std::string_view& rest, Kind kind) {
    std::int32_t index = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
    if (error != std::errc{}) bad_corner(word);
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (index == 0) fail("face refers to " + named(kind, 0) + ", but counting begins at 1, or at -1 from the end");
    const auto distance = static_cast<std::size_t>(std::abs(std::int64_t{index}));
    if (distance <= counts_[kind]) return;
    if (index > 0) {
      forward_.push_back({line_, kind, distance});
    } else {
      fail("face refers to " + counted(distance, kind) + " back, but the file has " + counted(counts_[kind], kind) +
           " before this line");
    }
  }

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  std::array<std::size_t, 3> counts_{};
  std::vector<Reference> forward_;  // to what may come later in the file
  std::vector<std::uint32_t> corner_counts_;
};

}  // namespace glint::detail
