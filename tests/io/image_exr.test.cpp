// SPDX-License-Identifier: MIT
#include <glint/io/image_exr.hpp>  // first, so the header proves it stands alone

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <support/catch.hpp>
#include <support/shared.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_image_exr {

namespace {

using glint::ExrCompression;
using glint::ExrPixel;
using glint::Image;
using glint::IoError;
using glint::read_exr;
using glint::Rgb;
using glint::write_exr;
using glint::testing::content_of;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

/// Radiance of every magnitude, negative values included.
Image noise(glint::Vec2i size, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> exponent(-10, 10);
  Image image{size};
  for (Rgb& pixel : image.pixels()) {
    pixel = {std::exp2(exponent(random)), -std::exp2(exponent(random)), exponent(random)};
  }
  return image;
}

/// A file of one value a pixel, written by OpenEXR itself: the channel's name, 10 x + y, and the windows.
template <class T>
void write_channels(const std::filesystem::path& path, Imf::PixelType type, const std::vector<std::string>& names,
                    Imath::Box2i display, Imath::Box2i data) {
  const int width = data.max.x - data.min.x + 1;
  std::vector<T> values;
  for (int y = data.min.y; y <= data.max.y; ++y) {
    for (int x = data.min.x; x <= data.max.x; ++x) values.push_back(static_cast<T>(static_cast<float>(10 * x + y)));
  }
  Imf::Header header(display, data);
  Imf::FrameBuffer frame;
  for (const auto& name : names) {
    header.channels().insert(name, Imf::Channel(type));
    frame.insert(name,
                 Imf::Slice::Make(type, values.data(), data, sizeof(T), sizeof(T) * static_cast<std::size_t>(width)));
  }
  Imf::OutputFile file(path.string().c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(data.max.y - data.min.y + 1);
}

Imath::Box2i box(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y1}};
}

}  // namespace

TEST_CASE("exr: float images come back bit by bit, under every compression", "[io][exr]") {
  const TemporaryDirectory directory;
  const auto compression =
      GENERATE(ExrCompression::None, ExrCompression::Rle, ExrCompression::Zip, ExrCompression::Piz);
  Image image = noise({37, 41});
  image(3, 2) = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::denorm_min(), -0.0F};
  write_exr(image, directory / "a.exr", {.compression = compression});
  const Image back = read_exr(directory / "a.exr");
  CHECK(back == image);
  CHECK(std::bit_cast<std::uint32_t>(back(3, 2).b) == 0x80000000U);
  CHECK(directory.entries() == 1);
}

TEST_CASE("exr: the first row of the image is the top row of the file", "[io][exr]") {
  const TemporaryDirectory directory;
  write_channels<float>(directory / "a.exr", Imf::FLOAT, {"R", "G", "B"}, box(0, 0, 4, 2), box(0, 0, 4, 2));
  const Image image = read_exr(directory / "a.exr");
  REQUIRE(image.size() == glint::Vec2i{5, 3});
  CHECK(image(4, 0) == Rgb{40});  // y points down in OpenEXR
  CHECK(image(4, 2) == Rgb{42});
}

TEST_CASE("exr: half images come back within half a unit of the 11 bit mantissa", "[io][exr]") {
  const TemporaryDirectory directory;
  const Image image = noise({29, 17});
  write_exr(image, directory / "a.exr", {.pixel = ExrPixel::Half});
  const Image back = read_exr(directory / "a.exr");
  REQUIRE(back.size() == image.size());
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const Rgb error = back.pixels()[i] - image.pixels()[i];
    const Rgb bound = image.pixels()[i] * Rgb{0x1p-11F};  // magnitudes are those of normal halves
    CHECK(std::abs(error.r) <= std::abs(bound.r));
    CHECK(std::abs(error.g) <= std::abs(bound.g));
    CHECK(std::abs(error.b) <= std::max(std::abs(bound.b), 0x1p-25F));
  }
}

TEST_CASE("exr: half keeps bright values finite, and infinity and NaN what they are", "[io][exr]") {
  const TemporaryDirectory directory;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  write_exr(Image{{1, 1}, {1e6F, -1e6F, infinity}}, directory / "a.exr", {.pixel = ExrPixel::Half});
  CHECK(read_exr(directory / "a.exr")(0, 0) == Rgb{65504, -65504, infinity});
  write_exr(Image{{1, 1}, Rgb{std::nanf("")}}, directory / "a.exr", {.pixel = ExrPixel::Half});
  CHECK(std::isnan(read_exr(directory / "a.exr")(0, 0).g));
}

TEST_CASE("exr: half takes less space than float", "[io][exr]") {
  const TemporaryDirectory directory;
  write_exr(noise({64, 64}), directory / "float.exr");
  write_exr(noise({64, 64}), directory / "half.exr", {.pixel = ExrPixel::Half});
  CHECK(content_of(directory / "half.exr").size() * 10 < content_of(directory / "float.exr").size() * 7);
}

TEST_CASE("exr: the same image is the same file", "[io][exr]") {
  const TemporaryDirectory directory;
  write_exr(noise({20, 30}), directory / "a.exr");
  write_exr(noise({20, 30}), directory / "b.exr");
  CHECK(content_of(directory / "a.exr") == content_of(directory / "b.exr"));
}

TEST_CASE("exr: half, float and integer channels are read alike", "[io][exr]") {
  const TemporaryDirectory directory;
  const auto window = box(0, 0, 6, 8);
  write_channels<float>(directory / "float.exr", Imf::FLOAT, {"B", "G", "R"}, window, window);
  write_channels<half>(directory / "half.exr", Imf::HALF, {"B", "G", "R"}, window, window);
  write_channels<std::uint32_t>(directory / "uint.exr", Imf::UINT, {"B", "G", "R"}, window, window);
  const Image image = read_exr(directory / "float.exr");
  CHECK(image(6, 8) == Rgb{68});
  CHECK(read_exr(directory / "half.exr") == image);  // integers up to 68 are exact in half
  CHECK(read_exr(directory / "uint.exr") == image);
}

TEST_CASE("exr: a single channel is gray, alpha or not", "[io][exr]") {
  const TemporaryDirectory directory;
  const auto window = box(0, 0, 3, 2);
  for (const std::vector<std::string>& names : {std::vector<std::string>{"Y"}, {"Z"}, {"A", "Y"}, {"depth"}}) {
    write_channels<half>(directory / "a.exr", Imf::HALF, names, window, window);
    CHECK(read_exr(directory / "a.exr")(3, 1) == Rgb{31});
  }
}

TEST_CASE("exr: color with further channels is read without them, a missing color is 0", "[io][exr]") {
  const TemporaryDirectory directory;
  const auto window = box(0, 0, 3, 2);
  write_channels<half>(directory / "a.exr", Imf::HALF, {"A", "B", "G", "R", "Z"}, window, window);
  CHECK(read_exr(directory / "a.exr")(3, 1) == Rgb{31});
  write_channels<half>(directory / "a.exr", Imf::HALF, {"G", "R"}, window, window);
  CHECK(read_exr(directory / "a.exr")(3, 1) == Rgb{31, 31, 0});
}

TEST_CASE("exr: channels of no known meaning are an error that names them", "[io][exr]") {
  const TemporaryDirectory directory;
  const auto window = box(0, 0, 3, 2);
  const auto path = directory / "a.exr";
  write_channels<half>(path, Imf::HALF, {"u", "v"}, window, window);
  CHECK(message_of<IoError>([&] { (void)read_exr(path); }, path.string()) ==
        ": has the channels u, v, expected R, G and B, or a single one");
}

TEST_CASE("exr: the display window is the image: data beyond is left out, missing data is black", "[io][exr]") {
  const TemporaryDirectory directory;
  write_channels<float>(directory / "a.exr", Imf::FLOAT, {"R", "G", "B"}, box(10, 20, 13, 22), box(8, 21, 12, 25));
  const Image image = read_exr(directory / "a.exr");
  REQUIRE(image.size() == glint::Vec2i{4, 3});
  CHECK(image(0, 0) == Rgb{0});         // (10, 20): above the data
  CHECK(image(0, 1) == Rgb{100 + 21});  // (10, 21)
  CHECK(image(2, 2) == Rgb{120 + 22});  // (12, 22)
  CHECK(image(3, 2) == Rgb{0});         // (13, 22): right of the data
  write_channels<float>(directory / "b.exr", Imf::FLOAT, {"R", "G", "B"}, box(0, 0, 1, 1), box(-5, -5, -4, -4));
  CHECK(read_exr(directory / "b.exr") == Image{{2, 2}});  // apart from each other
}

TEST_CASE("exr: tiled files are read", "[io][exr]") {
  const TemporaryDirectory directory;
  const Image image = noise({50, 33});
  const std::size_t row = sizeof(Rgb) * 50;
  Imf::Header header(50, 33);
  header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
  Imf::FrameBuffer frame;
  const Rgb& first = image.pixels().front();
  for (const auto& [name, channel] : {std::pair{"R", &first.r}, {"G", &first.g}, {"B", &first.b}}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, channel, header.dataWindow(), sizeof(Rgb), row));
  }
  {
    Imf::TiledOutputFile file((directory / "a.exr").string().c_str(), header);
    file.setFrameBuffer(frame);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  CHECK(read_exr(directory / "a.exr") == image);
}

TEST_CASE("exr: of several parts the first is read", "[io][exr]") {
  const TemporaryDirectory directory;
  {
    std::vector<Imf::Header> headers;
    for (const char* const name : {"first", "second"}) {
      Imf::Header header(3, 2);
      header.setName(name);
      header.setType(Imf::SCANLINEIMAGE);
      header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
      headers.push_back(header);
    }
    Imf::MultiPartOutputFile file((directory / "a.exr").string().c_str(), headers.data(), 2);
    for (int i = 0; i < 2; ++i) {
      const std::vector<float> values(6, static_cast<float>(i + 1));
      Imf::FrameBuffer frame;
      frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), headers[0].dataWindow()));
      Imf::OutputPart part(file, i);
      part.setFrameBuffer(frame);
      part.writePixels(2);
    }
  }
  CHECK(read_exr(directory / "a.exr") == Image{{3, 2}, Rgb{1}});
}

TEST_CASE("exr: a file cut after any byte is an error", "[io][exr]") {
  const TemporaryDirectory directory;
  const auto compression = GENERATE(ExrCompression::None, ExrCompression::Zip, ExrCompression::Piz);
  write_exr(noise({9, 40}), directory / "a.exr", {.pixel = ExrPixel::Half, .compression = compression});
  const std::string whole = content_of(directory / "a.exr");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto path = directory.write("cut.exr", whole.substr(0, size));
    CAPTURE(size);
    CHECK(message_of<IoError>([&] { (void)read_exr(path); }, path.string())
              .starts_with(": is not a complete OpenEXR image"));
  }
}

TEST_CASE("exr: changed bytes are an error or an image, never a crash", "[io][exr]") {
  const TemporaryDirectory directory;
  write_exr(noise({9, 40}), directory / "a.exr", {.pixel = ExrPixel::Half, .compression = ExrCompression::None});
  const std::string whole = content_of(directory / "a.exr");
  const std::size_t display = whole.find("displayWindow");
  std::mt19937 random(7);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) damaged[random() % 400] = static_cast<char>(random());  // most of it is the header
    damaged.replace(display, 40, whole, display, 40);  // a large display of little data is valid, and slow
    const auto path = directory.write("damaged.exr", damaged);
    const std::string message = message_of<IoError>([&] { (void)read_exr(path); }, path.string());
    CHECK((message == "no error" || message.starts_with(": ")));
  }
}

TEST_CASE("exr: a header that claims a huge image is refused before anything is allocated", "[io][exr]") {
  const TemporaryDirectory directory;
  write_exr(noise({4, 4}), directory / "a.exr", {.compression = ExrCompression::None});
  std::string file = content_of(directory / "a.exr");
  // The windows are four little-endian 32-bit numbers: after the name, its zero, "box2i", its zero and the size.
  for (const std::string window : {"dataWindow", "displayWindow"}) {
    const std::size_t x_max = file.find(window) + window.size() + 1 + 6 + 4 + 8;
    file.replace(x_max, 4, std::string("\xff\xff\xff\x1f", 4));
  }
  const auto path = directory.write("huge.exr", file);
  CHECK(message_of<IoError>([&] { (void)read_exr(path); }, path.string()) ==
        ": the header claims 536870912 x 4 pixels, expected 1 to 268435456 in all");
}

TEST_CASE("exr: an uncompressed file shorter than the pixels its header claims is refused", "[io][exr]") {
  const TemporaryDirectory directory;
  write_exr(noise({9, 4}), directory / "a.exr", {.compression = ExrCompression::None});
  std::string file = content_of(directory / "a.exr");
  file[file.find("dataWindow") + 10 + 1 + 6 + 4 + 8 + 2] = 1;  // the third byte of the last column, 8
  const auto path = directory.write("wide.exr", file);
  CHECK(message_of<IoError>([&] { (void)read_exr(path); }, path.string()) ==
        ": is not a complete OpenEXR image: the header claims " + std::to_string(4 * (9 + 65536)) +
            " pixels, more than the file holds");
}

TEST_CASE("exr: what is no OpenEXR file is an error", "[io][exr]") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(read_exr(directory / "missing.exr"), IoError);
  CHECK_THROWS_AS(read_exr(directory.path()), IoError);
  CHECK_THROWS_AS(read_exr(directory.write("empty.exr", "")), IoError);
  CHECK_THROWS_AS(read_exr(directory.write("text.exr", "This is no image, but it is long enough for one.")), IoError);
}

TEST_CASE("exr: what cannot be written is an error that changes nothing", "[io][exr]") {
  const TemporaryDirectory directory;
  const Image image = noise({4, 4});
  CHECK_THROWS_AS(write_exr(image, directory / "missing/a.exr"), IoError);
  CHECK_THROWS_AS(write_exr(image, directory.path()), IoError);
  const auto path = directory.write("former.exr", "former");
  CHECK(message_of<IoError>([&] { write_exr(Image{}, path); }, path.string()) ==
        ": cannot be written: the image is empty");
  CHECK(content_of(path) == "former");
  CHECK(directory.entries() == 1);
}

TEST_CASE("exr: the reference images are read", "[io][exr][shared]") {
  const auto path = glint::testing::shared_path("scenes/course/reference/cbox_no_light.exr");
  if (!path) return;
  const Image image = read_exr(*path);
  CHECK(image.size() == glint::Vec2i{512, 512});
  Rgb sum;
  for (const Rgb& pixel : image.pixels()) sum += pixel;
  CHECK(is_finite(sum));
  CHECK(luminance(sum) > 0);
}

}  // namespace test_io_image_exr
