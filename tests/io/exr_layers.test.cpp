// SPDX-License-Identifier: MIT
#include <glint/io/exr_layers.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_exr_layers {

namespace {

using glint::Channel;
using glint::ExrCompression;
using glint::IoError;
using glint::Layers;
using glint::read_exr_layers;
using glint::write_exr_layers;
using glint::testing::content_of;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

using Floats = std::vector<float>;
using Integers = std::vector<std::uint32_t>;

/// Three by two pixels, in the alphabetical order in which files have channels: all that a float can be, and integers
/// that no float is.
Layers some_layers() {
  constexpr float inf = std::numeric_limits<float>::infinity();
  return {{3, 2},
          {{"B", Floats{0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F}},
           {"G", Floats{1, 2, 3, 4, 5, 6}},
           {"N.X", Floats{-1, -0.5F, 0, 0.5F, 1, 1e-30F}},
           {"R", Floats{70'000, 1e30F, -1e-38F, 3.1415927F, -0.0F, 65'504}},
           {"Z", Floats{inf, 1, 2, 3, 4, inf}},
           {"id", Integers{0, 16'777'217, 4'294'967'295U, 3, 2, 1}}}};
}

/// Written by OpenEXR itself: one channel of 10 x + y, of a type, sampling and windows.
void write_channel(const std::filesystem::path& path, const Imf::Channel& kind, Imath::Box2i display,
                   Imath::Box2i data) {
  const int width = data.max.x - data.min.x + 1;
  std::vector<std::uint32_t> integers;
  std::vector<half> halves;
  for (int y = data.min.y; y <= data.max.y; ++y) {
    for (int x = data.min.x; x <= data.max.x; ++x) {
      integers.push_back(static_cast<std::uint32_t>(10 * x + y));
      halves.emplace_back(static_cast<float>(10 * x + y));
    }
  }
  Imf::Header header(display, data);
  header.channels().insert("id", kind);
  const bool integer = kind.type == Imf::UINT;
  const std::size_t size = integer ? sizeof(std::uint32_t) : sizeof(half);
  const void* first = integer ? static_cast<const void*>(integers.data()) : static_cast<const void*>(halves.data());
  Imf::FrameBuffer frame;
  frame.insert("id", Imf::Slice::Make(kind.type, first, data, size, size * static_cast<std::size_t>(width),
                                      kind.xSampling, kind.ySampling));
  Imf::OutputFile file(path.string().c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(data.max.y - data.min.y + 1);
}

}  // namespace

TEST_CASE("exr layers: every number of every channel comes back bit by bit", "[io][exr_layers]") {
  const TemporaryDirectory directory;
  const Layers written = some_layers();
  for (const auto compression : {ExrCompression::None, ExrCompression::Rle, ExrCompression::Zip, ExrCompression::Piz}) {
    CAPTURE(static_cast<int>(compression));
    write_exr_layers(written, directory / "layers.exr", compression);
    const Layers read = read_exr_layers(directory / "layers.exr");
    CHECK(read == written);
    CHECK(std::signbit(std::get<Floats>(read.channels[3].values)[4]));  // −0 equals 0
  }
}

TEST_CASE("exr layers: who reads the picture alone finds it, and a picture's file has one layer", "[io][exr_layers]") {
  const TemporaryDirectory directory;
  write_exr_layers(some_layers(), directory / "layers.exr");
  const glint::Image picture = glint::read_exr(directory / "layers.exr");
  CHECK(picture == glint::image_of(some_layers(), ""));
  CHECK(picture(1, 0) == glint::Rgb{1e30F, 2, 0.2F});

  glint::write_exr(picture, directory / "picture.exr");
  const Layers layers = read_exr_layers(directory / "picture.exr");
  CHECK(glint::layer_names(layers) == std::vector<std::string>{""});
  CHECK(glint::image_of(layers, "") == picture);
}

TEST_CASE("exr layers: files say that their colors are those of Rec. 709", "[io][exr_layers]") {
  const TemporaryDirectory directory;
  write_exr_layers(some_layers(), directory / "layers.exr");
  glint::write_exr(glint::Image{{2, 2}}, directory / "picture.exr");
  for (const char* const name : {"layers.exr", "picture.exr"}) {
    const Imf::InputFile file((directory / name).string().c_str());
    REQUIRE(Imf::hasChromaticities(file.header()));
    const Imf::Chromaticities& colors = Imf::chromaticities(file.header());
    // ITU-R BT.709-6, items 1.2 and 1.3; the white is D65.
    CHECK(colors.red == Imath::V2f(0.64F, 0.33F));
    CHECK(colors.green == Imath::V2f(0.30F, 0.60F));
    CHECK(colors.blue == Imath::V2f(0.15F, 0.06F));
    CHECK(colors.white == Imath::V2f(0.3127F, 0.3290F));
  }
}

TEST_CASE("exr layers: the display window is read, with zeros where there is no data", "[io][exr_layers]") {
  const TemporaryDirectory directory;
  const Imath::Box2i display({0, 0}, {2, 1});
  write_channel(directory / "id.exr", Imf::Channel(Imf::UINT), display, {{1, 1}, {4, 3}});
  // Of the pixels (x, y) with 0 ≤ x ≤ 2 and 0 ≤ y ≤ 1 the data has (1, 1) and (2, 1).
  CHECK(read_exr_layers(directory / "id.exr") == Layers{{3, 2}, {{"id", Integers{0, 0, 0, 0, 11, 21}}}});
  write_channel(directory / "id.exr", Imf::Channel(Imf::HALF), display, display);
  CHECK(read_exr_layers(directory / "id.exr") == Layers{{3, 2}, {{"id", Floats{0, 10, 20, 1, 11, 21}}}});
  write_channel(directory / "id.exr", Imf::Channel(Imf::UINT), display, {{5, 5}, {6, 6}});
  CHECK(read_exr_layers(directory / "id.exr") == Layers{{3, 2}, {{"id", Integers(6)}}});
}

TEST_CASE("exr layers: a file that cannot be read is named, with the cause", "[io][exr_layers]") {
  const TemporaryDirectory directory;
  const auto problem = [&](const char* name) {
    return message_of<IoError>([&] { (void)read_exr_layers(directory / name); });
  };
  CHECK(problem("missing.exr").find("missing.exr") != std::string::npos);
  directory.write("text.exr", "not an image");
  CHECK(problem("text.exr").find("is not a complete OpenEXR image") != std::string::npos);
  write_exr_layers(some_layers(), directory / "whole.exr");
  const std::string whole = content_of(directory / "whole.exr");
  directory.write("half.exr", whole.substr(0, whole.size() - 10));
  CHECK(problem("half.exr").find("is not a complete OpenEXR image") != std::string::npos);
  write_channel(directory / "coarse.exr", Imf::Channel(Imf::UINT, 2, 2), {{0, 0}, {3, 3}}, {{0, 0}, {3, 3}});
  CHECK(problem("coarse.exr").find("has the channel id at less than full resolution") != std::string::npos);
}

TEST_CASE("exr layers: what is no picture is not written", "[io][exr_layers]") {
  const TemporaryDirectory directory;
  const auto problem = [&](const Layers& layers) {
    return message_of<IoError>([&] { write_exr_layers(layers, directory / "a.exr"); });
  };
  CHECK(problem({}).find("there are no pixels or channels") != std::string::npos);
  CHECK(problem({{2, 2}, {}}).find("there are no pixels or channels") != std::string::npos);
  CHECK(problem({{2, 1}, {{"", Floats(2)}}}).find("a channel has no name") != std::string::npos);
  CHECK(problem({{2, 1}, {{"Z", Floats(3)}}}).find("the channel Z has 3 numbers, expected one a pixel, 2") !=
        std::string::npos);
  CHECK(problem({{2, 1}, {{"Z", Floats(2)}, {"Z", Integers(2)}}}).find("two channels are called Z") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(directory / "a.exr"));
}

}  // namespace test_io_exr_layers
