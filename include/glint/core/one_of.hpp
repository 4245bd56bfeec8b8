// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace glint {

template <typename... Ts>
class OneOf;

namespace detail {

template <typename T, typename... Ts>
inline constexpr bool is_among = (std::is_same_v<T, Ts> || ...);

/// OneOf<…> of the distinct types in a list; the type itself where there is just one.
template <typename Unique, typename... Rest>
struct Distinct;
template <typename... Us>
struct Distinct<OneOf<Us...>> {
  using type = OneOf<Us...>;
};
template <typename U>
struct Distinct<OneOf<U>> {
  using type = U;
};
template <typename... Us, typename T, typename... Rest>
struct Distinct<OneOf<Us...>, T, Rest...>
    : std::conditional_t<is_among<T, Us...>, Distinct<OneOf<Us...>, Rest...>, Distinct<OneOf<Us..., T>, Rest...>> {};

/// What a forwarded member function asks of each alternative.
template <typename T, typename... A>
concept Evaluates = requires(const T& x, const A&... a) {
  x.evaluate(a...);
};
template <typename T, typename... A>
concept HasPdf = requires(const T& x, const A&... a) {
  x.pdf(a...);
};
template <typename T, typename... A>
concept Samples = requires(const T& x, const A&... a) {
  x.sample(a...);
};
template <typename T, typename... A>
concept HasPower = requires(const T& x, const A&... a) {
  x.power(a...);
};
template <typename T, typename... A>
concept CastsRay = requires(const T& x, const A&... a) {
  x.ray(a...);
};
template <typename T, typename... A>
concept HasRays = requires(const T& x, const A&... a) {
  x.rays(a...);
};
template <typename T, typename... A>
concept Streams = requires(const T& x, const A&... a) {
  x.stream(a...);
};
template <typename T>
concept HasIsSpecular = requires(const T& x) {
  x.is_specular();
};
template <typename T>
concept HasRadius = requires(const T& x) {
  x.radius;
};
template <typename T>
concept HasNext1d = requires(T& x) {
  x.next_1d();
};
template <typename T>
concept HasNext2d = requires(T& x) {
  x.next_2d();
};

}  // namespace detail

/// A value that is one of the listed types, chosen at run time: the open sum type by which users mix their own
/// materials, lights, textures with the library's. No base class, no allocation, no virtual call.
///
/// It forwards the member functions that the library's concepts name, so that OneOf<A, B> models a concept when A and
/// B do. Where the alternatives return different types, it returns the OneOf of those.
template <typename... Ts>
class OneOf {
 public:
  /// Requires an argument of one of the types: no conversions, so that no alternative is chosen by accident.
  template <typename T>
    requires detail::is_among<std::remove_cvref_t<T>, Ts...>
  constexpr OneOf(T&& value) : value_(std::forward<T>(value)) {}

  /// The first type's default value, where it has one.
  constexpr OneOf() requires std::default_initializable<std::variant<Ts...>>
  = default;

  /// Calls f with the value held; all calls must return the same type.
  template <typename F>
  constexpr decltype(auto) visit(F&& f) const {
    return pick<0>(*this, f);
  }
  template <typename F>
  constexpr decltype(auto) visit(F&& f) {
    return pick<0>(*this, f);
  }

  /// Calls f with the value held; the results, of whatever types, come back as one OneOf.
  template <typename F>
  [[nodiscard]] constexpr auto transform(F&& f) const {
    using Result =
        typename detail::Distinct<OneOf<>, std::remove_cvref_t<std::invoke_result_t<F&, const Ts&>>...>::type;
    return visit([&](const auto& x) { return Result(f(x)); });
  }

  /// The value if it has this type, else null.
  template <typename T>
  [[nodiscard]] constexpr const T* get_if() const noexcept {
    return std::get_if<T>(&value_);
  }

  template <typename... A>
    requires(detail::Evaluates<Ts, A...>&&...)
  [[nodiscard]] constexpr auto evaluate(const A&... a) const {
    return visit([&](const auto& x) { return x.evaluate(a...); });
  }
  template <typename... A>
    requires(detail::HasPdf<Ts, A...>&&...)
  [[nodiscard]] constexpr auto pdf(const A&... a) const {
    return visit([&](const auto& x) { return x.pdf(a...); });
  }
  template <typename... A>
    requires(detail::Samples<Ts, A...>&&...)
  [[nodiscard]] constexpr auto sample(const A&... a) const {
    return visit([&](const auto& x) { return x.sample(a...); });
  }
  template <typename... A>
    requires(detail::HasPower<Ts, A...>&&...)
  [[nodiscard]] constexpr auto power(const A&... a) const {
    return visit([&](const auto& x) { return x.power(a...); });
  }
  template <typename... A>
    requires(detail::CastsRay<Ts, A...>&&...)
  [[nodiscard]] constexpr auto ray(const A&... a) const {
    return visit([&](const auto& x) { return x.ray(a...); });
  }
  [[nodiscard]] constexpr bool is_specular() const requires(detail::HasIsSpecular<Ts>&&...) {
    return visit([](const auto& x) { return x.is_specular(); });
  }
  [[nodiscard]] constexpr float radius() const requires(detail::HasRadius<Ts>&&...) {
    return visit([](const auto& x) { return x.radius; });
  }
  [[nodiscard]] constexpr float next_1d() requires(detail::HasNext1d<Ts>&&...) {
    return visit([](auto& x) { return x.next_1d(); });
  }
  [[nodiscard]] constexpr auto next_2d() requires(detail::HasNext2d<Ts>&&...) {
    return visit([](auto& x) { return x.next_2d(); });
  }
  template <typename... A>
    requires(detail::HasRays<Ts, A...>&&...)
  [[nodiscard]] constexpr auto rays(const A&... a) const {
    return transform([&](const auto& x) { return x.rays(a...); });
  }
  template <typename... A>
    requires(detail::Streams<Ts, A...>&&...)
  [[nodiscard]] constexpr auto stream(const A&... a) const {
    return transform([&](const auto& x) { return x.stream(a...); });
  }

  [[nodiscard]] friend constexpr bool operator==(const OneOf&,
                                                 const OneOf&) requires(std::equality_comparable<Ts>&&...) = default;

 private:
  /// A chain of comparisons: compilers turn it into a switch and inline the calls, which std::visit prevents.
  template <std::size_t I, typename Self, typename F>
  static constexpr decltype(auto) pick(Self& self, F& f) {
    if constexpr (I + 1 == sizeof...(Ts)) {
      return f(*std::get_if<I>(&self.value_));
    } else {
      if (self.value_.index() == I) return f(*std::get_if<I>(&self.value_));
      return pick<I + 1>(self, f);
    }
  }

  std::variant<Ts...> value_;
};

}  // namespace glint
