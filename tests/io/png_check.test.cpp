// SPDX-License-Identifier: MIT
#include <glint/io/png_check.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <string>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_png_check {

using namespace std::string_literals;

namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>((value >> shift) & 0xFFU));
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
         big_endian(glint::detail::crc32(type + data));
}

const std::string signature(glint::detail::png_signature);

}  // namespace

TEST_CASE("png check: the checksum is CRC-32, whose check value is published", "[io][png]") {
  CHECK(glint::detail::crc32("123456789") == 0xCBF43926U);  // the "check" of CRC-32/ISO-HDLC in every catalog
  CHECK(glint::detail::crc32("IEND") == 0xAE426082U);       // the last four bytes of every PNG file
}

TEST_CASE("png check: whole chunks up to IEND pass, whatever follows", "[io][png]") {
  const std::string file = signature + chunk("tEXt", "any data") + chunk("IEND", "");
  CHECK_NOTHROW(glint::detail::require_whole_png("a", file));
  CHECK_NOTHROW(glint::detail::require_whole_png("a", file + "trailing"));
}

TEST_CASE("png check: a file cut after any byte is truncated", "[io][png]") {
  const std::string file =
      signature + chunk("tEXt", "any data") + chunk("IDAT", ""s + '\0' + "pixels") + chunk("IEND", "");
  for (std::size_t size = signature.size(); size < file.size(); ++size) {
    CAPTURE(size);
    CHECK(glint::testing::message_of<glint::IoError>([&] {
            glint::detail::require_whole_png("a", file.substr(0, size));
          }) == "a: is truncated: the PNG ends without its IEND chunk");
  }
}

TEST_CASE("png check: a changed bit is found and located", "[io][png]") {
  std::string file = signature + chunk("tEXt", "any data") + chunk("IEND", "");
  file[18] = static_cast<char>(file[18] ^ 1);
  // 8 bytes of signature, then length, type and 8 bytes of data: the checksum begins at 8 + 4 + 4 + 8 = 24.
  CHECK(glint::testing::message_of<glint::IoError>([&] { glint::detail::require_whole_png("a", file); }) ==
        "a: is damaged: the checksum at byte 24 disagrees");
}

TEST_CASE("png check: a length that reaches beyond the file does not wrap around", "[io][png]") {
  const std::string file = signature + big_endian(0xFFFFFFFFU) + "IDAT" + "some data";
  CHECK_THROWS_AS(glint::detail::require_whole_png("a", file), glint::IoError);
}

TEST_CASE("png check: the size in the header is within the limits", "[io][png]") {
  const auto file = [](std::uint32_t width, std::uint32_t height) {
    return signature + chunk("IHDR", big_endian(width) + big_endian(height) + "depth") + chunk("IEND", "");
  };
  CHECK_NOTHROW(glint::detail::require_whole_png("a", file(16384, 16384)));
  CHECK_THROWS_AS(glint::detail::require_whole_png("a", file(16384, 16385)), glint::IoError);
  CHECK_THROWS_AS(glint::detail::require_whole_png("a", file(0xFFFFFFFFU, 0xFFFFFFFFU)), glint::IoError);
  CHECK_THROWS_AS(glint::detail::require_whole_png("a", file(0, 1)), glint::IoError);
}

}  // namespace test_io_png_check
