// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <stb_image.h>
#include <stb_image_write.h>

#include <glint/color/image.hpp>
#include <glint/color/srgb.hpp>
#include <glint/color/tone.hpp>
#include <glint/color/tone_curve.hpp>
#include <glint/io/error.hpp>
#include <glint/io/file.hpp>
#include <glint/io/image_limits.hpp>
#include <glint/io/png_check.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// What the numbers of an 8-bit or 16-bit image mean: sRGB for pictures, linear for data such as normal maps.
enum class Encoding { Srgb, Linear };

/// Shapes:   how a PNG is developed.
/// Units:    stops: each doubles the light.
struct PngOptions {
  float exposure_stops = 0;
  ToneCurve curve = ToneCurve::Clip;

  [[nodiscard]] friend bool operator==(const PngOptions&, const PngOptions&) = default;
};

namespace detail {

/// Feeds stb_image from memory, and notices when it asks for more than there is: it would make pixels of what is
/// missing.
class WatchedBytes {
 public:
  explicit WatchedBytes(std::string_view bytes) noexcept : rest_(bytes) {}

  [[nodiscard]] bool overrun() const noexcept { return overrun_; }
  [[nodiscard]] static stbi_io_callbacks callbacks() noexcept { return {read, skip, at_end}; }

 private:
  /// stb_image's first call fills its look-ahead buffer. Filling that again may come up short at the end of the file,
  /// unless nothing is left for the byte in want; any other target wants all it asks for. The stand-in for a missing
  /// byte is not 0, at which the HDR decoder would wait forever, nor 0xFF, at which the JPEG decoder would.
  static int read(void* self, char* target, int wanted) noexcept {
    auto& bytes = *static_cast<WatchedBytes*>(self);
    if (bytes.look_ahead_ == nullptr) bytes.look_ahead_ = target;
    const bool ahead = target == bytes.look_ahead_;
    const auto size = static_cast<std::size_t>(wanted);
    const std::size_t count = std::min(size, bytes.rest_.size());
    bytes.overrun_ = bytes.overrun_ || (ahead ? count == 0 : count < size);
    std::memcpy(target, bytes.rest_.data(), count);
    bytes.rest_.remove_prefix(count);
    if (!ahead || count > 0) return static_cast<int>(count);
    *target = '\xfe';
    return 1;
  }
  static void skip(void* self, int count) noexcept {
    auto& bytes = *static_cast<WatchedBytes*>(self);
    const auto size = static_cast<std::size_t>(std::max(count, 0));
    bytes.overrun_ = bytes.overrun_ || size > bytes.rest_.size();
    bytes.rest_.remove_prefix(std::min(size, bytes.rest_.size()));
  }
  static int at_end(void* self) noexcept { return static_cast<WatchedBytes*>(self)->rest_.empty() ? 1 : 0; }

  std::string_view rest_;
  const char* look_ahead_ = nullptr;
  bool overrun_ = false;
};

[[nodiscard]] inline IoError undecodable(const std::filesystem::path& path, const WatchedBytes& source) {
  if (source.overrun()) return {path, "is truncated"};
  const char* const reason = stbi_failure_reason();
  return {path, std::string("cannot be decoded: ") + (reason == nullptr ? "unknown reason" : reason)};
}

/// Refuses what is none of our formats: stb_image would take many a file for a TGA, which has no signature.
inline void require_known_format(const std::filesystem::path& path, std::string_view bytes) {
  using namespace std::string_view_literals;
  for (const auto signature : {png_signature, "\xff\xd8\xff"sv, "BM"sv, "#?RADIANCE\n"sv, "#?RGBE\n"sv}) {
    if (bytes.substr(0, signature.size()) == signature) return;
  }
  if (bytes.empty()) throw IoError(path, "is empty, expected an image");
  const auto extension = path.extension();
  if (extension != ".tga" && extension != ".TGA") throw IoError(path, "is not a PNG, JPEG, BMP, TGA or HDR image");
}

/// Refuses a size before the pixels are decoded.
inline void require_readable_size(const std::filesystem::path& path, std::string_view bytes) {
  const auto callbacks = WatchedBytes::callbacks();
  WatchedBytes source(bytes);
  Vec2i size{0};
  int channels = 0;
  if (stbi_info_from_callbacks(&callbacks, &source, &size.x, &size.y, &channels) == 0) throw undecodable(path, source);
  glint::require_readable_size(path, size.x, std::abs(std::int64_t{size.y}));  // a BMP below 0 begins with the top row
}

/// Decodes an image by one of stb_image's loaders; `value` turns its samples into linear light.
template <class Sample, class Value>
[[nodiscard]] Image load_image(const std::filesystem::path& path, std::string_view bytes,
                               Sample* (*load)(const stbi_io_callbacks*, void*, int*, int*, int*, int), Value value) {
  const auto callbacks = WatchedBytes::callbacks();
  WatchedBytes source(bytes);
  Vec2i size{0};
  int channels = 0;
  const std::unique_ptr<Sample, void (*)(void*)> samples(load(&callbacks, &source, &size.x, &size.y, &channels, 3),
                                                         stbi_image_free);
  if (!samples || source.overrun()) throw undecodable(path, source);
  Image image{size};
  const Sample* sample = samples.get();
  for (Rgb& pixel : image.pixels()) {
    pixel = {value(sample[0]), value(sample[1]), value(sample[2])};
    sample += 3;
  }
  return image;
}

/// The linear light of every integer sample.
template <class Sample>
[[nodiscard]] std::vector<float> decoding_table(Encoding encoding) {
  constexpr std::size_t largest = std::numeric_limits<Sample>::max();
  std::vector<float> table(largest + 1);
  for (std::size_t i = 0; i <= largest; ++i) {
    const float value = static_cast<float>(i) / static_cast<float>(largest);
    table[i] = encoding == Encoding::Srgb ? decode_srgb(value) : value;
  }
  return table;
}

[[nodiscard]] inline bool is_16_bit(std::string_view bytes) {
  const auto callbacks = WatchedBytes::callbacks();
  WatchedBytes source(bytes);
  return stbi_is_16_bit_from_callbacks(&callbacks, &source) != 0;
}

/// stb_image_write's way out: its context is the stream.
inline void append_to_stream(void* stream, void* data, int size) {
  static_cast<std::ofstream*>(stream)->write(static_cast<const char*>(data), size);
}

}  // namespace detail

/// Reads a PNG, JPEG, BMP, TGA or Radiance HDR image into linear colors. Alpha is left out, gray becomes color.
///
/// Shapes:   8 and 16 bits a channel are decoded as `encoding` says; HDR is linear whatever it says.
/// Errors:   IoError where the file is missing, of another kind, damaged, truncated, or larger than max_image_pixels.
///           A part of an image is never returned.
[[nodiscard]] inline Image read_ldr(const std::filesystem::path& path, Encoding encoding = Encoding::Srgb) {
  const std::string bytes = read_file(path);
  detail::require_known_format(path, bytes);
  if (bytes.starts_with(detail::png_signature)) detail::require_whole_png(path, bytes);
  detail::require_readable_size(path, bytes);
  if (bytes.starts_with("#?")) {
    return detail::load_image<float>(path, bytes, stbi_loadf_from_callbacks, std::identity{});
  }
  if (detail::is_16_bit(bytes)) {
    const auto table = detail::decoding_table<std::uint16_t>(encoding);
    return detail::load_image<std::uint16_t>(path, bytes, stbi_load_16_from_callbacks,
                                             [&](std::uint16_t sample) { return table[sample]; });
  }
  const auto table = detail::decoding_table<std::uint8_t>(encoding);
  return detail::load_image<std::uint8_t>(path, bytes, stbi_load_from_callbacks,
                                          [&](std::uint8_t sample) { return table[sample]; });
}

/// Writes an 8-bit sRGB PNG, in one step: see replace_file. What the curve leaves outside [0, 1] is clamped; NaN
/// becomes black.
///
/// Ensures:  without exposure and curve, read_ldr gives each color in [0, 1] back within half a step of 1/255 in sRGB.
/// Errors:   IoError where the image is empty or the file cannot be written.
inline void write_png(const Image& image, const std::filesystem::path& path, const PngOptions& options = {}) {
  if (image.empty()) throw IoError(path, "cannot be written: the image is empty");
  const auto samples = to_srgb8(image, {.exposure = options.exposure_stops, .curve = options.curve});
  replace_file(path, [&](std::ofstream& stream) {
    if (stbi_write_png_to_func(detail::append_to_stream, &stream, image.width(), image.height(), 3, samples.data(),
                               3 * image.width()) == 0) {
      throw IoError(path, "cannot be written as PNG");
    }
  });
}

/// Writes a Radiance HDR image, in one step: see replace_file. A pixel shares one exponent among its channels: 8 bits
/// of the largest channel remain. Negative values and NaN become 0.
///
/// Errors:   IoError where the image is empty or the file cannot be written.
inline void write_hdr(const Image& image, const std::filesystem::path& path) {
  if (image.empty()) throw IoError(path, "cannot be written: the image is empty");
  constexpr float largest = 1e38F;  // the format ends at 2^127
  std::vector<float> samples;
  samples.reserve(3 * image.pixels().size());
  for (const Rgb& pixel : image.pixels()) {
    for (const float value : {pixel.r, pixel.g, pixel.b}) samples.push_back(value > 0 ? std::min(value, largest) : 0);
  }
  replace_file(path, [&](std::ofstream& stream) {
    if (stbi_write_hdr_to_func(detail::append_to_stream, &stream, image.width(), image.height(), 3, samples.data()) ==
        0) {
      throw IoError(path, "cannot be written as HDR");
    }
  });
}

}  // namespace glint
