// SPDX-License-Identifier: MIT
#include <glint/io/image.hpp>  // first, so the header proves it stands alone

#include <string>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_image {

using glint::Image;
using glint::IoError;
using glint::read_image;
using glint::write_image;
using glint::testing::content_of;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

TEST_CASE("image file: the extension chooses the format, in either case", "[io][image]") {
  const TemporaryDirectory directory;
  const Image image{{3, 2}, {0.25F, 1, 0}};
  const auto [name, signature] =
      GENERATE(std::pair{"a.exr", "\x76\x2f\x31\x01"}, std::pair{"a.EXR", "\x76\x2f\x31\x01"},
               std::pair{"a.hdr", "#?RADIANCE"}, std::pair{"a.b.Hdr", "#?RADIANCE"});
  write_image(image, directory / name);
  CHECK(content_of(directory / name).starts_with(signature));
  CHECK(read_image(directory / name) == image);  // powers of two are exact in both
}

TEST_CASE("image file: the encoding is that of 8-bit images", "[io][image]") {
  const TemporaryDirectory directory;
  write_image(Image{{1, 1}, 0.5F}, directory / "a.png");
  // 0.5 is 0.7354 in sRGB, in bytes 187.5: one of the neighbors. Read as linear it stays there.
  CHECK(read_image(directory / "a.png", glint::Encoding::Linear)(0, 0).r == Approx(0.7354).margin(0.5 / 255));
  CHECK(read_image(directory / "a.png")(0, 0).r == Approx(0.5).margin(0.005));
  write_image(Image{{1, 1}, 0.5F}, directory / "a.exr");
  CHECK(read_image(directory / "a.exr", glint::Encoding::Linear) == read_image(directory / "a.exr"));
}

TEST_CASE("image file: other extensions are errors that name those that work", "[io][image]") {
  const std::string name = GENERATE("a.gif", "a", "", "png", "a.exr.bak");
  CAPTURE(name);
  CHECK(message_of<IoError>([&] { (void)read_image(name); }, name) ==
        ": cannot be read as an image: expected .exr, .hdr, .png, .jpg, .jpeg, .bmp or .tga");
  CHECK(message_of<IoError>(
            [&] {
              write_image(Image{{1, 1}}, name);
            },
            name) == ": cannot be written as an image: expected .exr, .hdr or .png");
}

}  // namespace test_io_image
