// SPDX-License-Identifier: MIT
#include <glint/io/image_limits.hpp>  // first, so the header proves it stands alone

#include <cstdint>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_image_limits {

using glint::max_image_pixels;
using glint::require_readable_size;

TEST_CASE("image limits: sizes up to the limit are fine, on either side", "[io][limits]") {
  CHECK_NOTHROW(require_readable_size("a", 1, 1));
  CHECK_NOTHROW(require_readable_size("a", max_image_pixels, 1));
  CHECK_NOTHROW(require_readable_size("a", 1, max_image_pixels));
  CHECK_NOTHROW(require_readable_size("a", 16384, 16384));  // 2^14 squared is 2^28
}

TEST_CASE("image limits: an empty side, or one pixel row too many, is refused", "[io][limits]") {
  const std::int64_t width = GENERATE(std::int64_t{-1}, std::int64_t{0}, std::int64_t{16385}, std::int64_t{1} << 62);
  CAPTURE(width);
  CHECK_THROWS_AS(require_readable_size("a", width, 16384), glint::IoError);
  CHECK_THROWS_AS(require_readable_size("a", 16384, width), glint::IoError);
}

TEST_CASE("image limits: the message names what the file claims", "[io][limits]") {
  CHECK(glint::testing::message_of<glint::IoError>([] { require_readable_size("a.png", 100'000, 90'000); }) ==
        "a.png: the header claims 100000 x 90000 pixels, expected 1 to 268435456 in all");
}

}  // namespace test_io_image_limits
