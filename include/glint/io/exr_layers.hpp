// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>

#include <glint/color/layers.hpp>
#include <glint/io/error.hpp>
#include <glint/io/image_exr.hpp>
#include <glint/io/image_limits.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The most numbers that read_exr_layers reads from one file.
inline constexpr std::int64_t max_layer_values = 16 * max_image_pixels;

namespace detail {

/// A channel as it is in the file, but for halves, which become floats; full of zeros.
[[nodiscard]] inline Channel empty_channel(const std::string& name, Imf::PixelType type, std::size_t pixels) {
  if (type == Imf::UINT) return {name, std::vector<std::uint32_t>(pixels)};
  return {name, std::vector<float>(pixels)};
}

inline void require_readable_layers(const std::filesystem::path& path, const Imf::Header& header) {
  const Vec2i size = window_size(header.dataWindow());
  std::int64_t values = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw IoError(path, std::string("has the channel ") + channel.name() + " at less than full resolution");
    }
    values += std::int64_t{size.x} * size.y;
  }
  if (values == 0) throw IoError(path, "has no channels");
  if (values <= max_layer_values) return;
  throw IoError(path, "has " + std::to_string(values) + " numbers in all channels, expected at most " +
                          std::to_string(max_layer_values));
}

/// Where OpenEXR finds, or is to put, a channel's numbers in a window.
template <typename C>
[[nodiscard]] Imf::Slice exr_slice(C& channel, const Imath::Box2i& window) {
  return std::visit(
      [&](auto& values) {
        using Number = std::remove_cvref_t<decltype(values[0])>;
        const Imf::PixelType type = std::is_integral_v<Number> ? Imf::UINT : Imf::FLOAT;
        const std::size_t row = sizeof(Number) * static_cast<std::size_t>(window_size(window).x);
        return Imf::Slice::Make(type, values.data(), window, sizeof(Number), row);
      },
      channel.values);
}

/// What of the data window shows in the display window; zero where there is no data.
[[nodiscard]] inline Layers framed(Layers data, const Imath::Box2i& data_window, const Imath::Box2i& display_window) {
  if (data_window == display_window) return data;
  Layers display{window_size(display_window)};
  const auto pixels = static_cast<std::size_t>(display.size.x) * static_cast<std::size_t>(display.size.y);
  const int x_begin = std::max(data_window.min.x, display_window.min.x);
  const int x_end = std::min(data_window.max.x, display_window.max.x) + 1;
  const auto place = [](int x, int y, const Imath::Box2i& window) {
    return std::ptrdiff_t{y - window.min.y} * window_size(window).x + (x - window.min.x);
  };
  const auto copy_rows = [&](const auto& from, auto& to) {
    const int y_end = std::min(data_window.max.y, display_window.max.y) + 1;
    for (int y = std::max(data_window.min.y, display_window.min.y); y < y_end && x_begin < x_end; ++y) {
      std::copy_n(from.begin() + place(x_begin, y, data_window), x_end - x_begin,
                  to.begin() + place(x_begin, y, display_window));
    }
  };
  for (const Channel& channel : data.channels) {
    std::visit(
        [&](const auto& from) {
          std::remove_cvref_t<decltype(from)> to(pixels);
          copy_rows(from, to);
          display.channels.push_back({channel.name, std::move(to)});
        },
        channel.values);
  }
  return display;
}

[[nodiscard]] inline Layers read_exr_channels(const Imf::Header& header, Imf::MultiPartInputFile& file) {
  const auto& window = header.dataWindow();
  Layers layers{window_size(window)};
  const auto pixels = static_cast<std::size_t>(layers.size.x) * static_cast<std::size_t>(layers.size.y);
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    layers.channels.push_back(empty_channel(channel.name(), channel.channel().type, pixels));
  }
  Imf::FrameBuffer frame;
  for (Channel& channel : layers.channels) frame.insert(channel.name, exr_slice(channel, window));
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  return layers;
}

inline void require_writable_layers(const std::filesystem::path& path, const Layers& layers) {
  const auto pixels = static_cast<std::size_t>(layers.size.x) * static_cast<std::size_t>(layers.size.y);
  if (pixels == 0 || layers.channels.empty()) throw IoError(path, "cannot be written: there are no pixels or channels");
  for (const Channel& channel : layers.channels) {
    if (channel.name.empty()) throw IoError(path, "cannot be written: a channel has no name");
    if (channel.size() != pixels) {
      throw IoError(path, "cannot be written: the channel " + channel.name + " has " + std::to_string(channel.size()) +
                              " numbers, expected one a pixel, " + std::to_string(pixels));
    }
    if (find_channel(layers, channel.name) != &channel) {
      throw IoError(path, "cannot be written: two channels are called " + channel.name);
    }
  }
}

}  // namespace detail

/// Reads all channels of an OpenEXR file's first part: half and float ones as floats, integers as integers.
///
/// Shapes:   as read_exr: the display window's size. Channels are in alphabetical order.
/// Errors:   IoError as for read_exr; also where a channel is at less than full resolution, or all together have more
///           than max_layer_values numbers.
[[nodiscard]] inline Layers read_exr_layers(const std::filesystem::path& path) {
  return detail::with_exr_file(path, [&](Imf::MultiPartInputFile& file) {
    const Imf::Header& header = detail::require_readable_header(path, file);
    detail::require_readable_layers(path, header);
    return detail::framed(detail::read_exr_channels(header, file), header.dataWindow(), header.displayWindow());
  });
}

/// Writes an OpenEXR file of one part with all channels, in one step: see replace_file. Who reads R, G and B alone, as
/// read_exr does, finds the picture proper.
///
/// Units:    colors as write_exr; all else as it is.
/// Ensures:  all numbers come back bit by bit.
/// Errors:   IoError where there is nothing to write, two channels have one name, a channel has not one number a pixel,
///           or the file cannot be written.
inline void write_exr_layers(const Layers& layers, const std::filesystem::path& path,
                             ExrCompression compression = ExrCompression::Zip) {
  detail::require_writable_layers(path, layers);
  detail::replace_exr_file(path, [&](std::ofstream& stream) {
    Imf::Header header = detail::exr_header(layers.size, compression);
    Imf::FrameBuffer source;
    for (const Channel& channel : layers.channels) {
      const Imf::Slice slice = detail::exr_slice(channel, header.dataWindow());
      header.channels().insert(channel.name, Imf::Channel(slice.type));
      source.insert(channel.name, slice);
    }
    Imf::StdOFStream output(stream, path.string().c_str());
    Imf::OutputFile file(output, header, 0);
    file.setFrameBuffer(source);
    file.writePixels(layers.size.y);
  });
}

}  // namespace glint
