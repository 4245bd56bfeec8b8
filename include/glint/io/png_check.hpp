// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <glint/io/error.hpp>
#include <glint/io/image_limits.hpp>

namespace glint::detail {

/// CRC-32 of one byte at a time. Source: ISO/IEC 15948 (PNG), annex D: the polynomial 0xEDB88320, reflected.
[[nodiscard]] constexpr std::array<std::uint32_t, 256> crc32_table() noexcept {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
    table[byte] = remainder;
  }
  return table;
}

[[nodiscard]] constexpr std::uint32_t crc32(std::string_view bytes) noexcept {
  constexpr auto table = crc32_table();
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xFFU] ^ (crc >> 8U);
  return ~crc;
}

[[nodiscard]] constexpr std::uint32_t big_endian_32(std::string_view bytes) noexcept {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = (value << 8U) | static_cast<unsigned char>(byte);
  return value;
}

inline constexpr std::string_view png_signature{"\x89PNG\r\n\x1a\n"};

/// Checks what stb_image does not, or not in so many words: that each chunk is whole and unchanged, that the last one
/// is there, and that the size is below max_image_pixels.
///
/// Requires: the bytes begin with png_signature.
/// Errors:   IoError.
inline void require_whole_png(const std::filesystem::path& path, std::string_view bytes) {
  constexpr std::size_t frame = 12;  // length, type and checksum of a chunk, 4 bytes each
  std::string_view rest = bytes.substr(png_signature.size());
  while (rest.size() >= frame) {
    const std::size_t length = big_endian_32(rest);
    if (length > rest.size() - frame) break;
    const std::string_view checked = rest.substr(4, 4 + length);
    const std::string_view type = checked.substr(0, 4);
    const std::string_view data = checked.substr(4);
    if (crc32(checked) != big_endian_32(rest.substr(8 + length))) {
      throw IoError(path, "is damaged: the checksum at byte " +
                              std::to_string(bytes.size() - rest.size() + 8 + length) + " disagrees");
    }
    if (type == "IHDR" && length >= 8) require_readable_size(path, big_endian_32(data), big_endian_32(data.substr(4)));
    if (type == "IEND") return;
    rest.remove_prefix(frame + length);
  }
  throw IoError(path, "is truncated: the PNG ends without its IEND chunk");
}

}  // namespace glint::detail
