// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <glint/color/image.hpp>
#include <glint/core/config.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// One number a pixel, row by row from the top: measures as floats, counts and indices as integers.
struct Channel {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;

  [[nodiscard]] std::size_t size() const noexcept {
    return std::visit([](const auto& v) { return v.size(); }, values);
  }
  /// As a float: integers above 2²⁴ are rounded. Requires: i < size().
  [[nodiscard]] float at(std::size_t i) const noexcept {
    GLINT_ASSERT(i < size());
    if (const auto* const floats = std::get_if<std::vector<float>>(&values)) return (*floats)[i];
    return static_cast<float>((*std::get_if<std::vector<std::uint32_t>>(&values))[i]);
  }

  [[nodiscard]] friend bool operator==(const Channel&, const Channel&) = default;
};

/// A picture of any number of channels. As in OpenEXR files, the channel "albedo.R" is one of the layer "albedo", and
/// "Z", without a dot, is a layer of its own; but R, G, B and A are channels of the picture proper, the layer "".
///
/// Requires: every channel has size.x · size.y values, and a name of its own.
struct Layers {
  Vec2i size{0};
  std::vector<Channel> channels{};

  [[nodiscard]] friend bool operator==(const Layers&, const Layers&) = default;
};

/// The layer that a channel belongs to.
[[nodiscard]] constexpr std::string_view layer_of(std::string_view channel) noexcept {
  if (const auto dot = channel.rfind('.'); dot != std::string_view::npos) return channel.substr(0, dot);
  const bool of_picture = channel == "R" || channel == "G" || channel == "B" || channel == "A";
  return of_picture ? std::string_view{} : channel;
}

/// The names of all layers, each once, in the order of their first channels.
[[nodiscard]] inline std::vector<std::string> layer_names(const Layers& layers) {
  std::vector<std::string> names;
  for (const Channel& channel : layers.channels) {
    const std::string_view layer = layer_of(channel.name);
    if (std::find(names.begin(), names.end(), layer) == names.end()) names.emplace_back(layer);
  }
  return names;
}

/// The channel of a name; null where there is none.
[[nodiscard]] inline const Channel* find_channel(const Layers& layers, std::string_view name) noexcept {
  for (const Channel& channel : layers.channels) {
    if (channel.name == name) return &channel;
  }
  return nullptr;
}

/// Adds an image as the channels R, G and B of a layer; of the picture proper where the name is empty.
///
/// Requires: the image has the layers' size; there are no such channels yet.
inline void add_image(Layers& layers, const Image& image, std::string_view layer = {}) {
  GLINT_ASSERT(image.size() == layers.size);
  const std::array<std::pair<const char*, float Rgb::*>, 3> parts{{{"R", &Rgb::r}, {"G", &Rgb::g}, {"B", &Rgb::b}}};
  for (const auto& [part, member] : parts) {
    std::vector<float> values;
    values.reserve(image.pixels().size());
    for (const Rgb& pixel : image.pixels()) values.push_back(pixel.*member);
    const std::string name = layer.empty() ? part : std::string(layer) + "." + part;
    layers.channels.push_back({name, std::move(values)});
  }
}

/// A layer as colors: its channels R, G and B; otherwise its first three in alphabetical order, as X, Y, Z or U, V are,
/// zero for those that are missing, and a single one as gray. Alpha is left out. Nothing where there is no such layer.
[[nodiscard]] inline std::optional<Image> image_of(const Layers& layers, std::string_view layer) {
  std::vector<const Channel*> parts;
  for (const Channel& channel : layers.channels) {
    const bool alpha = channel.name == "A" || channel.name.ends_with(".A");
    if (layer_of(channel.name) == layer && !alpha) parts.push_back(&channel);
  }
  if (parts.empty()) return std::nullopt;
  const auto rank = [](const Channel* channel) {
    const std::size_t color = std::string_view("RGB").find(channel->name.back());
    return std::pair(color, std::string_view(channel->name));  // no color: npos, after all that are
  };
  std::sort(parts.begin(), parts.end(), [&](const auto* a, const auto* b) { return rank(a) < rank(b); });

  Image image(layers.size);
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const auto part = [&](std::size_t c) { return c < parts.size() ? parts[c]->at(i) : 0.0F; };
    image.pixels()[i] = parts.size() == 1 ? Rgb(part(0)) : Rgb{part(0), part(1), part(2)};
  }
  return image;
}

}  // namespace glint
