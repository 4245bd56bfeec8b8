// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgba.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>

#include <glint/color/image.hpp>
#include <glint/io/error.hpp>
#include <glint/io/file.hpp>
#include <glint/io/image_limits.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// How a channel of an OpenEXR file stores a number. Half: 11 bits of mantissa, up to 65504.
enum class ExrPixel { Float, Half };

/// How an OpenEXR file is packed; none of these loses anything.
enum class ExrCompression { None, Rle, Zip, Piz };

/// Shapes:   32-bit float, so that what is read is what was written; Half files take about half the space.
struct ExrOptions {
  ExrPixel pixel = ExrPixel::Float;
  ExrCompression compression = ExrCompression::Zip;

  [[nodiscard]] friend bool operator==(const ExrOptions&, const ExrOptions&) = default;
};

namespace detail {

[[nodiscard]] inline std::string channel_names(const Imf::ChannelList& channels) {
  std::string names;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    names.append(names.empty() ? "" : ", ").append(channel.name());
  }
  return names.empty() ? "none" : names;
}

/// The three channels to be read as red, green and blue: R, G and B, or one for all of them. A file that has some of
/// R, G and B has zeros for the others.
[[nodiscard]] inline std::array<std::string, 3> color_channels(const std::filesystem::path& path,
                                                               const Imf::ChannelList& channels) {
  std::vector<std::string> others;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    const std::string name = channel.name();
    if (name == "R" || name == "G" || name == "B") return {"R", "G", "B"};
    if (name != "A") others.push_back(name);
  }
  if (others.size() == 1) return {others[0], others[0], others[0]};
  throw IoError(path, "has the channels " + channel_names(channels) + ", expected R, G and B, or a single one");
}

/// Requires: a size that require_readable_size accepts.
[[nodiscard]] inline Vec2i window_size(const Imath::Box2i& window) {
  return {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
}

/// Refuses a header that claims more than an uncompressed file holds: OpenEXR would make pixels of whatever is in its
/// buffer.
inline void require_uncompressed_pixels(const std::filesystem::path& path, const Imf::Header& header) {
  if (header.compression() != Imf::NO_COMPRESSION) return;
  std::uintmax_t pixel_size = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    const bool subsampled = channel.channel().xSampling != 1 || channel.channel().ySampling != 1;
    if (!subsampled) pixel_size += channel.channel().type == Imf::HALF ? 2 : 4;
  }
  const Vec2i size = window_size(header.dataWindow());
  const auto pixels = static_cast<std::uintmax_t>(size.x) * static_cast<std::uintmax_t>(size.y);
  std::error_code unknown;
  if (std::filesystem::file_size(path, unknown) >= pixel_size * pixels || unknown) return;
  throw IoError(path, "is not a complete OpenEXR image: the header claims " + std::to_string(pixels) +
                          " pixels, more than the file holds");
}

/// Where OpenEXR is to put the channels of a window's pixels, row by row from `first`.
[[nodiscard]] inline Imf::FrameBuffer frame_buffer(const std::array<std::string, 3>& names, Rgb& first,
                                                   const Imath::Box2i& window) {
  const std::size_t row = sizeof(Rgb) * static_cast<std::size_t>(window_size(window).x);
  const std::array<float*, 3> channels{&first.r, &first.g, &first.b};
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3 && (c == 0 || names[c] != names[0]); ++c) {
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, channels[c], window, sizeof(Rgb), row));
  }
  return frame;
}

/// The pixels of the data window.
[[nodiscard]] inline Image read_exr_pixels(const std::filesystem::path& path, Imf::MultiPartInputFile& file) {
  const auto& window = file.header(0).dataWindow();
  const auto names = color_channels(path, file.header(0).channels());
  Imf::InputPart part(file, 0);
  Image image{window_size(window)};
  part.setFrameBuffer(frame_buffer(names, image(0, 0), window));
  part.readPixels(window.min.y, window.max.y);
  if (names[0] == names[1]) {
    for (Rgb& pixel : image.pixels()) pixel = Rgb(pixel.r);
  }
  return image;
}

/// What of the data window shows in the display window; black where there is no data.
[[nodiscard]] inline Image framed(Image data, const Imath::Box2i& data_window, const Imath::Box2i& display_window) {
  if (data_window == display_window) return data;
  Image display{window_size(display_window)};
  const auto x_end = std::min(data_window.max.x, display_window.max.x);
  const auto y_end = std::min(data_window.max.y, display_window.max.y);
  for (int y = std::max(data_window.min.y, display_window.min.y); y <= y_end; ++y) {
    for (int x = std::max(data_window.min.x, display_window.min.x); x <= x_end; ++x) {
      display(x - display_window.min.x, y - display_window.min.y) = data(x - data_window.min.x, y - data_window.min.y);
    }
  }
  return display;
}

/// Refuses what is no flat picture of a readable size. Gives the header.
inline const Imf::Header& require_readable_header(const std::filesystem::path& path,
                                                  const Imf::MultiPartInputFile& file) {
  const Imf::Header& header = file.header(0);
  if (header.hasType() && Imf::isDeepData(header.type())) throw IoError(path, "holds deep data, expected flat pixels");
  for (const auto& window : {header.dataWindow(), header.displayWindow()}) {
    require_readable_size(path, std::int64_t{window.max.x} - window.min.x + 1,
                          std::int64_t{window.max.y} - window.min.y + 1);
  }
  require_uncompressed_pixels(path, header);
  return header;
}

/// Opens an OpenEXR file, calls f(file) and gives its result. What OpenEXR throws comes out as IoError.
template <typename F>
[[nodiscard]] auto with_exr_file(const std::filesystem::path& path, const F& f) {
  std::ifstream stream = open_file(path);
  try {
    Imf::StdIFStream input(stream, path.string().c_str());
    Imf::MultiPartInputFile file(input, 0, false);
    return f(file);
  } catch (const IoError&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(path, std::string("is not a complete OpenEXR image: ") + error.what());
  }
}

/// Calls write(stream) with a file in the place of the path, in one step. What OpenEXR throws comes out as IoError.
template <typename F>
void replace_exr_file(const std::filesystem::path& path, const F& write) {
  try {
    replace_file(path, write);
  } catch (const IoError&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(path, std::string("cannot be written: ") + error.what());
  }
}

[[nodiscard]] inline Imf::Compression exr_compression(ExrCompression compression) noexcept {
  switch (compression) {
    case ExrCompression::None:
      return Imf::NO_COMPRESSION;
    case ExrCompression::Rle:
      return Imf::RLE_COMPRESSION;
    case ExrCompression::Piz:
      return Imf::PIZ_COMPRESSION;
    case ExrCompression::Zip:
      break;
  }
  return Imf::ZIP_COMPRESSION;
}

/// A header without channels, which says that colors are those of Rec. 709: OpenEXR's default, spelled out.
[[nodiscard]] inline Imf::Header exr_header(Vec2i size, ExrCompression compression) {
  Imf::Header header(size.x, size.y);
  header.compression() = exr_compression(compression);
  Imf::addChromaticities(header, Imf::Chromaticities());
  return header;
}

/// The nearest half; a finite value beyond the range stays finite.
[[nodiscard]] inline half saturated_half(float value) noexcept {
  constexpr float largest = 65504;
  return half(std::isfinite(value) ? std::clamp(value, -largest, largest) : value);
}

[[nodiscard]] inline std::vector<half> halves(const Image& image) {
  std::vector<half> values;
  values.reserve(3 * image.pixels().size());
  for (const Rgb& pixel : image.pixels()) {
    for (const float value : {pixel.r, pixel.g, pixel.b}) values.push_back(saturated_half(value));
  }
  return values;
}

/// Writes three interleaved channels; `first` is the first of each.
template <class Channel>
void write_exr_pixels(std::ofstream& stream, const std::filesystem::path& path, Vec2i size, Imf::PixelType type,
                      ExrCompression compression, std::array<const Channel*, 3> first) {
  Imf::Header header = exr_header(size, compression);
  Imf::FrameBuffer source;
  const std::array<const char*, 3> names{"R", "G", "B"};
  const std::size_t stride = 3 * sizeof(Channel);
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(type));
    source.insert(names[c], Imf::Slice::Make(type, first[c], header.dataWindow(), stride,
                                             stride * static_cast<std::size_t>(size.x)));
  }
  Imf::StdOFStream output(stream, path.string().c_str());
  Imf::OutputFile file(output, header, 0);
  file.setFrameBuffer(source);
  file.writePixels(size.y);
}

}  // namespace detail

/// Reads an OpenEXR file: the first part, scan lines or tiles, half, float or integer channels.
///
/// Shapes:   the display window's size. Pixels the file has no data for are black; data outside is left out. R, G and B
///           are read, alpha is not applied; a single channel of any name, alpha aside, gives gray.
/// Units:    as in the file: taken to be linear Rec. 709, whatever its chromaticities say.
/// Errors:   IoError where the file is missing, truncated, visibly damaged, larger than max_image_pixels, deep, or has
///           other channels. OpenEXR files carry no checksums: changed bits may only change pixels.
[[nodiscard]] inline Image read_exr(const std::filesystem::path& path) {
  return detail::with_exr_file(path, [&](Imf::MultiPartInputFile& file) {
    const Imf::Header& header = detail::require_readable_header(path, file);
    return detail::framed(detail::read_exr_pixels(path, file), header.dataWindow(), header.displayWindow());
  });
}

/// Writes an OpenEXR file with the channels R, G and B, in one step: see replace_file.
///
/// Units:    linear, with the primaries and white of Rec. 709, which the file says.
/// Ensures:  Float pixels come back bit by bit; Half pixels are rounded to nearest, and finite values beyond ±65504
///           become ±65504.
/// Errors:   IoError where the image is empty or the file cannot be written.
inline void write_exr(const Image& image, const std::filesystem::path& path, const ExrOptions& options = {}) {
  if (image.empty()) throw IoError(path, "cannot be written: the image is empty");
  const auto write = [&](std::ofstream& stream) {
    if (options.pixel == ExrPixel::Half) {
      const auto values = detail::halves(image);
      const half* const first = values.data();
      detail::write_exr_pixels<half>(stream, path, image.size(), Imf::HALF, options.compression,
                                     {first, first + 1, first + 2});
    } else {
      const Rgb& first = image.pixels().front();
      detail::write_exr_pixels<float>(stream, path, image.size(), Imf::FLOAT, options.compression,
                                      {&first.r, &first.g, &first.b});
    }
  };
  detail::replace_exr_file(path, write);
}

}  // namespace glint
