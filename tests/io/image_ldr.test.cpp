// SPDX-License-Identifier: MIT
#include <glint/io/image_ldr.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_image_ldr {

namespace {

using glint::Encoding;
using glint::Image;
using glint::IoError;
using glint::read_ldr;
using glint::Rgb;
using glint::write_hdr;
using glint::write_png;
using glint::testing::content_of;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

Image gradient(glint::Vec2i size) {
  Image image{size};
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      image(x, y) = {static_cast<float>(x) / static_cast<float>(size.x),
                     static_cast<float>(y) / static_cast<float>(size.y), static_cast<float>(x * y % 7) / 7};
    }
  }
  return image;
}

/// Bytes of a picture of `channels` channels.
std::vector<std::uint8_t> picture(int width, int height, int channels) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < width * height * channels; ++i) bytes.push_back(static_cast<std::uint8_t>(i * 37 % 251));
  return bytes;
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>((value >> shift) & 0xFFU));
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
         big_endian(glint::detail::crc32(type + data));
}

/// A PNG of one row, its pixels stored without compression.
std::string png(std::uint32_t width, std::uint32_t height, int bits, const std::string& row) {
  std::string scan_line(1, '\0');  // filter: none
  scan_line += row;
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : scan_line) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(scan_line.size());
  std::string zlib{"\x78\x01\x01", 3};
  for (const int part : {size & 0xFF, size >> 8, ~size & 0xFF, (~size >> 8) & 0xFF})
    zlib.push_back(static_cast<char>(part));
  zlib += scan_line + big_endian((b << 16U) | a);
  const std::string header =
      big_endian(width) + big_endian(height) + static_cast<char>(bits) + '\2' + std::string(3, '\0');
  return std::string(glint::detail::png_signature) + chunk("IHDR", header) + chunk("IDAT", zlib) + chunk("IEND", "");
}

/// A small file of each format, as stb_image_write makes them.
std::string sample_file(const TemporaryDirectory& directory, const std::string& extension, int width, int height) {
  const auto path = directory / ("sample" + extension);
  const std::string name = path.string();
  const auto bytes = picture(width, height, 3);
  if (extension == ".png") write_png(gradient({width, height}), path);
  if (extension == ".hdr") write_hdr(gradient({width, height}), path);
  if (extension == ".jpg") stbi_write_jpg(name.c_str(), width, height, 3, bytes.data(), 90);
  if (extension == ".bmp") stbi_write_bmp(name.c_str(), width, height, 3, bytes.data());
  if (extension == ".tga") stbi_write_tga(name.c_str(), width, height, 3, bytes.data());
  return content_of(path);
}

}  // namespace

TEST_CASE("png: colors come back within half a step of sRGB", "[io][png]") {
  const TemporaryDirectory directory;
  const Image image = gradient({61, 43});
  write_png(image, directory / "a.png");
  const Image encoded = read_ldr(directory / "a.png", Encoding::Linear);
  REQUIRE(encoded.size() == image.size());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const Rgb in = image.pixels()[i];
    const Rgb out = encoded.pixels()[i];
    CHECK(std::abs(out.r - glint::encode_srgb(in.r)) <= 0.5F / 255 + 1e-6F);
    CHECK(std::abs(out.g - glint::encode_srgb(in.g)) <= 0.5F / 255 + 1e-6F);
    CHECK(std::abs(out.b - glint::encode_srgb(in.b)) <= 0.5F / 255 + 1e-6F);
  }
}

TEST_CASE("png: every byte is decoded as sRGB or as linear", "[io][png]") {
  const TemporaryDirectory directory;
  std::string row;
  for (int i = 0; i < 256; ++i) row += std::string(3, static_cast<char>(i));
  const auto path = directory.write("a.png", png(256, 1, 8, row));
  const Image srgb = read_ldr(path);
  const Image linear = read_ldr(path, Encoding::Linear);
  for (int i = 0; i < 256; ++i) {
    CAPTURE(i);
    CHECK(linear(i, 0) == Rgb{static_cast<float>(i) / 255});
    CHECK(srgb(i, 0).g == Approx(glint::decode_srgb(i / 255.0)).epsilon(1e-5));
  }
}

TEST_CASE("png: 16-bit files keep their 16 bits", "[io][png]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("a.png", png(1, 1, 16, std::string("\x12\x34\x00\x01\xff\xff", 6)));
  CHECK(read_ldr(path, Encoding::Linear)(0, 0) == Rgb{0x1234 / 65535.0F, 1 / 65535.0F, 1});
  CHECK(read_ldr(path)(0, 0).r == Approx(glint::decode_srgb(0x1234 / 65535.0)).epsilon(1e-5));
}

TEST_CASE("png: a tone curve follows the exposure", "[io][png]") {
  const TemporaryDirectory directory;
  write_png(Image{{1, 1}, 0.5F}, directory / "a.png", {.exposure_stops = 1, .curve = glint::ToneCurve::Filmic});
  CHECK(read_ldr(directory / "a.png")(0, 0).r == Approx(glint::filmic_curve(1)).margin(0.005));
}

TEST_CASE("png: exposure doubles the light with each stop", "[io][png]") {
  const TemporaryDirectory directory;
  write_png(Image{{2, 2}, 0.1F}, directory / "a.png", {.exposure_stops = 2});
  write_png(Image{{2, 2}, 0.4F}, directory / "b.png");
  CHECK(content_of(directory / "a.png") == content_of(directory / "b.png"));
}

TEST_CASE("png: what light cannot be is clamped: brighter than white, negative, NaN", "[io][png]") {
  const TemporaryDirectory directory;
  Image image{{2, 1}, {7, -1, std::nanf("")}};
  image(1, 0) = std::numeric_limits<float>::infinity();
  write_png(image, directory / "a.png");
  const Image back = read_ldr(directory / "a.png");
  CHECK(back(0, 0) == Rgb{1, 0, 0});
  CHECK(back(1, 0) == Rgb{1});
}

TEST_CASE("png: gray becomes color, alpha is left out", "[io][png]") {
  const TemporaryDirectory directory;
  const auto channels = GENERATE(1, 2, 3, 4);
  CAPTURE(channels);
  const auto bytes = picture(5, 4, channels);
  stbi_write_png((directory / "a.png").string().c_str(), 5, 4, channels, bytes.data(), 5 * channels);
  const Image image = read_ldr(directory / "a.png", Encoding::Linear);
  REQUIRE(image.size() == glint::Vec2i{5, 4});
  const auto value = [&](std::size_t c) {
    return static_cast<float>(bytes[static_cast<std::size_t>(channels) * 7 + c]) / 255;
  };
  CHECK(image(2, 1) == (channels < 3 ? Rgb{value(0)} : Rgb{value(0), value(1), value(2)}));
}

TEST_CASE("hdr: a pixel comes back within one of 256 steps of its largest channel", "[io][hdr]") {
  const TemporaryDirectory directory;
  const int width = GENERATE(1, 7, 8, 130);  // runs are packed from a width of 8
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-20, 20);
  Image image{{width, 9}};
  for (Rgb& pixel : image.pixels()) {
    pixel = {std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random))};
  }
  write_hdr(image, directory / "a.hdr");
  const Image back = read_ldr(directory / "a.hdr");
  REQUIRE(back.size() == image.size());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const Rgb in = image.pixels()[i];
    const Rgb out = back.pixels()[i];
    const float step = max_component(in) / 128;  // the mantissa of the largest is 128 to 255
    CHECK(std::abs(out.r - in.r) <= step);
    CHECK(std::abs(out.g - in.g) <= step);
    CHECK(std::abs(out.b - in.b) <= step);
  }
}

TEST_CASE("hdr: negative values and NaN become 0, infinity a large number", "[io][hdr]") {
  const TemporaryDirectory directory;
  Image image{{2, 1}, {1, -1, std::nanf("")}};
  image(1, 0) = std::numeric_limits<float>::infinity();
  write_hdr(image, directory / "a.hdr");
  const Image back = read_ldr(directory / "a.hdr");
  CHECK(back(0, 0) == Rgb{1, 0, 0});
  CHECK(back(1, 0).r > 9e37F);
  CHECK(is_finite(back(1, 0)));
}

TEST_CASE("ldr: the first row of the image is the top row of the file", "[io][ldr]") {
  const TemporaryDirectory directory;
  const std::string extension = GENERATE(".png", ".bmp", ".tga", ".hdr", ".jpg");
  CAPTURE(extension);
  const auto path = directory.write("a" + extension, sample_file(directory, extension, 16, 8));
  const Image image = read_ldr(path, Encoding::Linear);
  REQUIRE(image.size() == glint::Vec2i{16, 8});
  const auto bytes = picture(16, 8, 3);
  if (extension == ".bmp" || extension == ".tga") {
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
      CHECK(image.pixels()[i].r == static_cast<float>(bytes[3 * i]) / 255);
      CHECK(image.pixels()[i].b == static_cast<float>(bytes[3 * i + 2]) / 255);
    }
  } else if (extension != ".jpg") {
    CHECK(image(15, 0).g < image(15, 7).g);  // of the gradient
  }
}

TEST_CASE("jpeg: a flat color comes back nearly", "[io][jpeg]") {
  const TemporaryDirectory directory;
  const std::vector<std::uint8_t> gray(3 * 20 * 12, 100);
  stbi_write_jpg((directory / "a.jpg").string().c_str(), 20, 12, 3, gray.data(), 95);
  const Image image = read_ldr(directory / "a.jpg", Encoding::Linear);
  REQUIRE(image.size() == glint::Vec2i{20, 12});
  CHECK(image(19, 11).g == Approx(100 / 255.0).margin(2 / 255.0));
}

TEST_CASE("bmp: rows may be stored from the top", "[io][bmp]") {
  const TemporaryDirectory directory;
  std::string file = sample_file(directory, ".bmp", 3, 2);
  const Image upwards = read_ldr(directory / "sample.bmp");
  file.replace(22, 4, std::string("\xfe\xff\xff\xff", 4));  // the height, 2, becomes -2
  const Image downwards = read_ldr(directory.write("a.bmp", file));
  REQUIRE(downwards.size() == upwards.size());
  CHECK(downwards(1, 0) == upwards(1, 1));
  CHECK(downwards(2, 1) == upwards(2, 0));
}

TEST_CASE("ldr: a file cut after any byte is an error", "[io][ldr]") {
  const TemporaryDirectory directory;
  const std::string extension = GENERATE(".png", ".jpg", ".bmp", ".tga", ".hdr");
  const int width = GENERATE(1, 5, 33);
  CAPTURE(extension, width);
  const std::string whole = sample_file(directory, extension, width, 9);
  CHECK_NOTHROW(read_ldr(directory / ("sample" + extension)));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto path = directory.write("cut" + extension, whole.substr(0, size));
    CAPTURE(size);
    CHECK_THROWS_AS(read_ldr(path), IoError);
  }
}

TEST_CASE("ldr: changed bytes are an error or an image, never a crash or an endless loop", "[io][ldr]") {
  const TemporaryDirectory directory;
  const std::string extension = GENERATE(".png", ".jpg", ".bmp", ".tga", ".hdr");
  const std::string whole = sample_file(directory, extension, 33, 9);
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) damaged[30 + random() % (damaged.size() - 30)] = static_cast<char>(random() % 3 * 127);
    const auto path = directory.write("damaged" + extension, damaged);
    const std::string message = message_of<IoError>([&] { (void)read_ldr(path); }, path.string());
    CHECK((message == "no error" || message.starts_with(": ")));
  }
}

TEST_CASE("png: any changed byte is found", "[io][png]") {
  const TemporaryDirectory directory;
  const std::string whole = sample_file(directory, ".png", 5, 4);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    const auto path = directory.write("damaged.png", damaged);
    CAPTURE(i);
    CHECK_THROWS_AS(read_ldr(path), IoError);
  }
}

TEST_CASE("ldr: a header that claims a huge image is refused before it is decoded", "[io][ldr]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("huge.png", png(100'000, 90'000, 8, "abc"));
  CHECK(message_of<IoError>([&] { (void)read_ldr(path); }, path.string()) ==
        ": the header claims 100000 x 90000 pixels, expected 1 to 268435456 in all");
  const auto hdr = directory.write("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 70000 +X 30000\nabcd");
  CHECK_THROWS_AS(read_ldr(hdr), IoError);
}

TEST_CASE("ldr: what is no image is an error that says so", "[io][ldr]") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(read_ldr(directory / "missing.png"), IoError);
  CHECK_THROWS_AS(read_ldr(directory.path()), IoError);
  const auto empty = directory.write("empty.png", "");
  CHECK(message_of<IoError>([&] { (void)read_ldr(empty); }, empty.string()) == ": is empty, expected an image");
  const auto text = directory.write("text.png", "This is no image, but it is long enough for one.");
  CHECK(message_of<IoError>([&] { (void)read_ldr(text); }, text.string()) ==
        ": is not a PNG, JPEG, BMP, TGA or HDR image");
}

TEST_CASE("ldr: what cannot be written is an error that changes nothing", "[io][ldr]") {
  const TemporaryDirectory directory;
  const Image image{{2, 2}};
  CHECK_THROWS_AS(write_png(image, directory / "missing/a.png"), IoError);
  CHECK_THROWS_AS(write_hdr(image, directory / "missing/a.hdr"), IoError);
  const auto path = directory.write("former", "former");
  CHECK_THROWS_AS(write_png(Image{}, path), IoError);
  CHECK_THROWS_AS(write_hdr(Image{}, path), IoError);
  CHECK(content_of(path) == "former");
  CHECK(directory.entries() == 1);
}

}  // namespace test_io_image_ldr
