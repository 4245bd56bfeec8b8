// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <memory>
#include <utility>

#include <glint/texture/concepts.hpp>

namespace glint {

/// A texture of any type behind one pointer: for textures made of textures where the program finds out which.
/// Copies share it. OneOf is faster where the types are known.
///
/// Cost: one indirect call.
class AnyTexture {
 public:
  template <Texture T>
    requires(!std::same_as<T, AnyTexture>)
  explicit AnyTexture(T texture)
      : texture_(std::make_shared<const T>(std::move(texture))),
        by_coordinates_(
            [](const void* held, const Vec2<float>& uv) { return static_cast<const T*>(held)->evaluate(uv); }),
        over_footprint_([](const void* held, const Vec2<float>& uv, const UvFootprint& over) {
          return color_at(*static_cast<const T*>(held), uv, over);
        }),
        on_surface_([](const void* held, const Surface& at) { return color_at(*static_cast<const T*>(held), at); }) {}

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv) const { return by_coordinates_(texture_.get(), uv); }
  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv, const UvFootprint& over) const {
    return over_footprint_(texture_.get(), uv, over);
  }
  [[nodiscard]] Rgb evaluate(const Surface& at) const { return on_surface_(texture_.get(), at); }

  /// The same texture, shared.
  [[nodiscard]] friend bool operator==(const AnyTexture& a, const AnyTexture& b) noexcept {
    return a.texture_ == b.texture_;
  }

 private:
  std::shared_ptr<const void> texture_;
  Rgb (*by_coordinates_)(const void*, const Vec2<float>&);
  Rgb (*over_footprint_)(const void*, const Vec2<float>&, const UvFootprint&);
  Rgb (*on_surface_)(const void*, const Surface&);
};

static_assert(FilteringTexture<AnyTexture> && SurfaceTexture<AnyTexture>);

}  // namespace glint
