// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

namespace glint {

template <typename... Ts>
class OneOf;

namespace detail {

template <typename T, typename... Ts>
inline constexpr bool is_among = (std::is_same_v<T, Ts> || ...);

template <typename T, typename... /*Rest*/>
struct FirstOf {
  using type = T;
};

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

template <typename F, typename... As>
using OneOfResults = typename Distinct<OneOf<>, std::remove_cvref_t<std::invoke_result_t<F, As>>...>::type;

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

/// The place of a type in a list. Requires: it is there.
template <typename T, typename... Ts>
[[nodiscard]] consteval std::uint8_t place_among() noexcept {
  std::uint8_t place = 0;
  (void)((std::is_same_v<T, Ts> || (++place, false)) || ...);
  return place;
}

/// Room for a value of one of the types, and which of them lives there.
template <typename... Ts>
class OneOfRoom {
  static_assert(sizeof...(Ts) <= 255);

 public:
  template <typename T, typename... A>
  explicit OneOfRoom(std::in_place_type_t<T> /*type*/, A&&... a) : place_(place_among<T, Ts...>()) {
    ::new (static_cast<void*>(room_)) T(std::forward<A>(a)...);
  }

  template <typename T>
  [[nodiscard]] bool holds() const noexcept {
    return place_ == place_among<T, Ts...>();
  }

  /// Requires: holds<T>(). Not by std::launder, which keeps compilers from seeing what was put there.
  template <typename T>
  [[nodiscard]] const T& as() const noexcept {
    return *static_cast<const T*>(static_cast<const void*>(room_));
  }
  template <typename T>
  [[nodiscard]] T& as() noexcept {
    return *static_cast<T*>(static_cast<void*>(room_));
  }

 protected:
  OneOfRoom() = default;  // for those who fill it at once

  void copy_from(const OneOfRoom& other) {
    (void)((other.holds<Ts>() && ::new (static_cast<void*>(room_)) Ts(other.as<Ts>())) || ...);
    place_ = other.place_;
  }
  void move_from(OneOfRoom& other) noexcept {
    (void)((other.holds<Ts>() && ::new (static_cast<void*>(room_)) Ts(std::move(other.as<Ts>()))) || ...);
    place_ = other.place_;
  }
  void destroy() noexcept { (void)((holds<Ts>() && (as<Ts>().~Ts(), true)) || ...); }

 private:
  alignas(Ts...) std::byte room_[std::max({sizeof(Ts)...})];
  std::uint8_t place_;
};

/// The same with what its values need to be copied and destroyed: nothing, or what they say.
///
/// std::variant would do, but compilers take longer over it: docs/decisions/sum_types.md.
template <bool trivially_copyable, typename... Ts>
class OneOfValue : public OneOfRoom<Ts...> {
 public:
  using OneOfRoom<Ts...>::OneOfRoom;
};
template <typename... Ts>
class OneOfValue<false, Ts...> : public OneOfRoom<Ts...> {
  static_assert((std::is_nothrow_move_constructible_v<Ts> && ...), "assignment would lose a value");

 public:
  using OneOfRoom<Ts...>::OneOfRoom;
  OneOfValue(const OneOfValue& other) requires(std::is_copy_constructible_v<Ts>&&...) : OneOfRoom<Ts...>() {
    this->copy_from(other);
  }
  OneOfValue(OneOfValue&& other) noexcept : OneOfRoom<Ts...>() { this->move_from(other); }
  OneOfValue& operator=(const OneOfValue& other) {
    if (this != &other) *this = OneOfValue(other);
    return *this;
  }
  OneOfValue& operator=(OneOfValue&& other) noexcept {
    if (this == &other) return *this;
    this->destroy();
    this->move_from(other);
    return *this;
  }
  ~OneOfValue() { this->destroy(); }
};

}  // namespace detail

/// A value that is one of the listed types, chosen at run time: the open sum type by which users mix their own
/// materials, lights, textures with the library's. No base class, no allocation, no virtual call.
///
/// It forwards the member functions that the library's concepts name, so that OneOf<A, B> models a concept when A and
/// B do. Where the alternatives return different types, it returns the OneOf of those.
template <typename... Ts>
class OneOf {
  using First = typename detail::FirstOf<Ts...>::type;

 public:
  /// Requires an argument of one of the types: no conversions, so that no alternative is chosen by accident.
  template <typename T>
    requires detail::is_among<std::remove_cvref_t<T>, Ts...>
  explicit(false) OneOf(T&& value) : value_(std::in_place_type<std::remove_cvref_t<T>>, std::forward<T>(value)) {}

  /// The first type's default value, where it has one.
  OneOf() requires(std::default_initializable<First>) : value_(std::in_place_type<First>) {}

  /// Calls f with the value held; all calls must return the same type.
  template <typename F>
  decltype(auto) visit(F&& f) const {
    return pick<Ts...>(*this, f);
  }
  template <typename F>
  decltype(auto) visit(F&& f) {
    return pick<Ts...>(*this, f);
  }

  /// Calls f with the value held; the results, of whatever types, come back as one OneOf.
  template <typename F>
  [[nodiscard]] auto transform(F&& f) const -> detail::OneOfResults<F&, const Ts&...> {
    return visit([&](const auto& x) { return detail::OneOfResults<F&, const Ts&...>(f(x)); });
  }

  /// The value if it has this type, else null.
  template <typename T>
  [[nodiscard]] const T* get_if() const noexcept {
    return value_.template holds<T>() ? &value_.template as<T>() : nullptr;
  }

  template <typename... A, typename T = First>
    requires(detail::Evaluates<Ts, A...>&&...)
  [[nodiscard]] auto evaluate(const A&... a) const -> decltype(std::declval<const T&>().evaluate(a...)) {
    return visit([&](const auto& x) { return x.evaluate(a...); });
  }
  template <typename... A, typename T = First>
    requires(detail::HasPdf<Ts, A...>&&...)
  [[nodiscard]] auto pdf(const A&... a) const -> decltype(std::declval<const T&>().pdf(a...)) {
    return visit([&](const auto& x) { return x.pdf(a...); });
  }
  template <typename... A, typename T = First>
    requires(detail::Samples<Ts, A...>&&...)
  [[nodiscard]] auto sample(const A&... a) const -> decltype(std::declval<const T&>().sample(a...)) {
    return visit([&](const auto& x) { return x.sample(a...); });
  }
  template <typename... A, typename T = First>
    requires(detail::HasPower<Ts, A...>&&...)
  [[nodiscard]] auto power(const A&... a) const -> decltype(std::declval<const T&>().power(a...)) {
    return visit([&](const auto& x) { return x.power(a...); });
  }
  template <typename... A, typename T = First>
    requires(detail::CastsRay<Ts, A...>&&...)
  [[nodiscard]] auto ray(const A&... a) const -> decltype(std::declval<const T&>().ray(a...)) {
    return visit([&](const auto& x) { return x.ray(a...); });
  }
  [[nodiscard]] bool is_specular() const requires(detail::HasIsSpecular<Ts>&&...) {
    return visit([](const auto& x) { return x.is_specular(); });
  }
  [[nodiscard]] float radius() const requires(detail::HasRadius<Ts>&&...) {
    return visit([](const auto& x) { return x.radius; });
  }
  [[nodiscard]] float next_1d() requires(detail::HasNext1d<Ts>&&...) {
    return visit([](auto& x) { return x.next_1d(); });
  }
  [[nodiscard]] auto next_2d() requires(detail::HasNext2d<Ts>&&...) {
    return visit([](auto& x) { return x.next_2d(); });
  }
  template <typename... A>
    requires(detail::HasRays<Ts, A...>&&...)
  [[nodiscard]] auto rays(const A&... a) const {
    return transform([&](const auto& x) { return x.rays(a...); });
  }
  template <typename... A>
    requires(detail::Streams<Ts, A...>&&...)
  [[nodiscard]] auto stream(const A&... a) const {
    return transform([&](const auto& x) { return x.stream(a...); });
  }

  [[nodiscard]] friend bool operator==(const OneOf& a, const OneOf& b) requires(std::equality_comparable<Ts>&&...) {
    return a.visit([&]<typename T>(const T& x) {
      const T* const y = b.template get_if<T>();
      return y != nullptr && x == *y;
    });
  }

 private:
  /// A chain of comparisons: compilers turn it into a switch and inline the calls, which a table of functions
  /// prevents.
  template <typename T, typename... Rest, typename Self, typename F>
  static decltype(auto) pick(Self& self, F& f) {
    if constexpr (sizeof...(Rest) == 0) {
      return f(self.value_.template as<T>());
    } else {
      if (self.value_.template holds<T>()) return f(self.value_.template as<T>());
      return pick<Rest...>(self, f);
    }
  }

  detail::OneOfValue<(std::is_trivially_copyable_v<Ts> && ...), Ts...> value_;
};

}  // namespace glint
