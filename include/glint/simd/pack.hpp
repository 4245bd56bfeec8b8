// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <glint/core/config.hpp>

namespace glint {

/// The lanes of T that fit a machine register; 1 where the compiler has no vector extensions.
#if !defined(__GNUC__)
template <typename T>
inline constexpr int register_lanes = 1;
#elif defined(__AVX512F__)
template <typename T>
inline constexpr int register_lanes = 64 / int(sizeof(T));
#elif defined(__AVX__)
template <typename T>
inline constexpr int register_lanes = 32 / int(sizeof(T));
#else
template <typename T>
inline constexpr int register_lanes = 16 / int(sizeof(T));
#endif

namespace detail {

/// W lanes that are computed by one instruction: a vector of the compiler's, or a plain number.
template <typename T, int W>
struct WordOf {
#if defined(__GNUC__)
  typedef T type __attribute__((vector_size(sizeof(T) * std::size_t(W))));
#endif
};
template <typename T>
struct WordOf<T, 1> {
  using type = T;
};

/// One bit a lane of a comparison. The extensions have no word for it, so this takes the builtins behind the
/// intrinsics, whose header would be a third of all that including a Bvh costs.
[[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t lane_bits(bool mask) noexcept {
  return std::uint32_t(mask);
}

#if defined(__GNUC__)
template <typename Mask>
[[nodiscard]] GLINT_ALWAYS_INLINE std::uint32_t lane_bits(const Mask& mask) noexcept {
  constexpr std::size_t bytes = sizeof(Mask);
  constexpr std::size_t lane = sizeof(mask[0]);
#if defined(__AVX512DQ__)
  if constexpr (bytes == 64 && lane == 4)
    return std::uint32_t(__builtin_ia32_cvtd2mask512(std::bit_cast<typename WordOf<int, 16>::type>(mask)));
  if constexpr (bytes == 64 && lane == 8)
    return std::uint32_t(__builtin_ia32_cvtq2mask512(std::bit_cast<typename WordOf<long long, 8>::type>(mask)));
#endif
#if defined(__AVX__)
  if constexpr (bytes == 32 && lane == 4)
    return std::uint32_t(__builtin_ia32_movmskps256(std::bit_cast<typename WordOf<float, 8>::type>(mask)));
  if constexpr (bytes == 32 && lane == 8)
    return std::uint32_t(__builtin_ia32_movmskpd256(std::bit_cast<typename WordOf<double, 4>::type>(mask)));
#endif
#if defined(__SSE2__)
  if constexpr (bytes == 16 && lane == 4)
    return std::uint32_t(__builtin_ia32_movmskps(std::bit_cast<typename WordOf<float, 4>::type>(mask)));
  if constexpr (bytes == 16 && lane == 8)
    return std::uint32_t(__builtin_ia32_movmskpd(std::bit_cast<typename WordOf<double, 2>::type>(mask)));
#endif
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < bytes / lane; ++i) bits |= std::uint32_t(mask[i] != 0) << i;
  return bits;
}
#endif

template <int W, typename Word>
GLINT_ALWAYS_INLINE void truncate_word(const Word& word, std::int32_t* to) noexcept {
#if defined(__GNUC__)
  if constexpr (W > 1) {
    const auto whole = __builtin_convertvector(word, typename WordOf<std::int32_t, W>::type);
    std::memcpy(to, &whole, sizeof(whole));
    return;
  }
#endif
  if constexpr (W == 1) *to = std::int32_t(word);
}

#if defined(__GNUC__)
/// W bytes as numbers of 32 bits. GCC converts one by one, so this takes the builtins behind the intrinsics.
template <int W>
[[nodiscard]] GLINT_ALWAYS_INLINE typename WordOf<std::int32_t, W>::type widened_bytes(
    const std::uint8_t* from) noexcept {
#if defined(__SSE2__) && !defined(__clang__)
  if constexpr (W == 4) {
    std::uint32_t whole;
    std::memcpy(&whole, from, sizeof(whole));
    const auto bytes = std::bit_cast<typename WordOf<char, 16>::type>(typename WordOf<std::uint32_t, 4>::type{whole});
    const typename WordOf<char, 16>::type none{};
    const auto pairs = std::bit_cast<typename WordOf<short, 8>::type>(__builtin_ia32_punpcklbw128(bytes, none));
    return std::bit_cast<typename WordOf<std::int32_t, 4>::type>(
        __builtin_ia32_punpcklwd128(pairs, typename WordOf<short, 8>::type{}));
  }
#endif
#if defined(__AVX2__) && !defined(__clang__)
  if constexpr (W == 8) {
    long long whole;
    std::memcpy(&whole, from, sizeof(whole));
    const auto bytes = std::bit_cast<typename WordOf<char, 16>::type>(typename WordOf<long long, 2>::type{whole});
    return std::bit_cast<typename WordOf<std::int32_t, 8>::type>(__builtin_ia32_pmovzxbd256(bytes));
  }
#endif
  typename WordOf<std::uint8_t, W>::type bytes;
  std::memcpy(&bytes, from, sizeof(bytes));
  return __builtin_convertvector(bytes, typename WordOf<std::int32_t, W>::type);
}
#endif

/// W whole numbers of a byte each. By way of 32 bits, for which there are instructions.
template <typename T, int W>
[[nodiscard]] GLINT_ALWAYS_INLINE typename WordOf<T, W>::type word_of_bytes(const std::uint8_t* from) noexcept {
#if defined(__GNUC__)
  if constexpr (W > 1) return __builtin_convertvector(widened_bytes<W>(from), typename WordOf<T, W>::type);
#endif
  if constexpr (W == 1) return T(*from);
}

/// The word as it stands: keeps the compiler from fusing the product that made it with what comes next.
template <typename Word>
[[nodiscard]] GLINT_ALWAYS_INLINE Word fenced_word(const Word& word) noexcept {
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12
#if defined(__SSE2__)
  if constexpr (std::is_floating_point_v<Word> && sizeof(Word) <= 8) {  // whose barrier is lost where GCC makes vectors
    Word opaque = word;
    __asm__("" : "+x"(opaque));
    return opaque;
  } else
#endif
      if constexpr (sizeof(Word) > 16) {  // which GCC takes apart, lane by lane, unless they are doubles
    using Doubles = typename WordOf<double, int(sizeof(Word) / sizeof(double))>::type;
    return std::bit_cast<Word>(__builtin_assoc_barrier(std::bit_cast<Doubles>(word)));
  } else {
    return __builtin_assoc_barrier(word);
  }
#else
  return word;  // Clang fuses within an expression only, and this is the end of one
#endif
}

/// The lanes of `a` whose bits are set, else those of `b`.
template <typename T, int W, typename Word>
[[nodiscard]] GLINT_ALWAYS_INLINE Word select_word(std::uint32_t bits, const Word& a, const Word& b) noexcept {
#if defined(__GNUC__)
  if constexpr (W > 1) {
    using Bits = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
    using BitsWord = typename WordOf<Bits, W>::type;
    const auto each = []<int... J>(std::integer_sequence<int, J...>) {
      return BitsWord{(Bits{1} << J)...};
    }
    (std::make_integer_sequence<int, W>{});
    return (((BitsWord{} + Bits(bits)) & each) != 0) ? a : b;
  }
#endif
  if constexpr (W == 1) return (bits & 1U) != 0 ? a : b;
}

/// All lanes of a word as one, by halves.
template <typename T, int W, typename Word, typename Fold>
[[nodiscard]] GLINT_ALWAYS_INLINE T folded_word(const Word& word, const Fold& fold) noexcept {
  if constexpr (W == 1) {
    return word;
  } else {
    const auto half = std::bit_cast<std::array<typename WordOf<T, W / 2>::type, 2>>(word);
    return folded_word<T, W / 2>(fold(half[0], half[1]), fold);
  }
}

}  // namespace detail

/// The same number, rounded as written: a product passed through here is not fused with a later sum, so that numbers
/// and packs give the same results, whatever the compiler and its flags.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE T fenced(T x) noexcept {
  return detail::fenced_word(x);
}

/// N lanes of T, computed W at a time: by vector registers, or with W = 1 by plain arithmetic on any compiler.
///
/// Each lane is rounded as the scalar operation would be, so all W give the same results.
///
/// Requires: N and W powers of two, N ≤ 32.
template <typename T, int N, int W = (N < register_lanes<T> ? N : register_lanes<T>)>
struct Pack {
  static_assert(N % W == 0 && std::has_single_bit(unsigned(N)) && N <= 32);
  using Word = typename detail::WordOf<T, W>::type;
  static constexpr int size = N;
  static constexpr int width = W;
  static constexpr std::size_t words = std::size_t(N / W);

  std::array<Word, words> word;

  [[nodiscard]] GLINT_ALWAYS_INLINE static Pack broadcast(T value) noexcept {
    Pack p;
    for (Word& w : p.word) w = value - Word{};  // which compilers know to be the value; + 0 would lose the sign of −0
    return p;
  }
  /// Lane i is lane(i).
  template <typename Lane>
  [[nodiscard]] GLINT_ALWAYS_INLINE static Pack generate(const Lane& lane) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) {
      p.word[i] = [&]<int... J>(std::integer_sequence<int, J...>) {
        return Word{lane(int(i) * W + J)...};
      }
      (std::make_integer_sequence<int, W>{});
    }
    return p;
  }
  /// N numbers from memory, aligned as T.
  [[nodiscard]] GLINT_ALWAYS_INLINE static Pack load(const T* from) noexcept {
    Pack p;
    std::memcpy(&p.word, from, sizeof(p.word));
    return p;
  }
  /// N whole numbers from memory, a byte each.
  [[nodiscard]] GLINT_ALWAYS_INLINE static Pack load(const std::uint8_t* from) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = detail::word_of_bytes<T, W>(from + i * std::size_t(W));
    return p;
  }
  GLINT_ALWAYS_INLINE void store(T* to) const noexcept { std::memcpy(to, &word, sizeof(word)); }

  [[nodiscard]] GLINT_ALWAYS_INLINE T operator[](int lane) const noexcept {
    if constexpr (W == 1)
      return word[std::size_t(lane)];
    else
      return word[std::size_t(lane / W)][lane % W];
  }
  GLINT_ALWAYS_INLINE void set(int lane, T value) noexcept {
    if constexpr (W == 1)
      word[std::size_t(lane)] = value;
    else
      word[std::size_t(lane / W)][lane % W] = value;
  }

  GLINT_ALWAYS_INLINE friend Pack operator+(const Pack& a, const Pack& b) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = a.word[i] + b.word[i];
    return p;
  }
  GLINT_ALWAYS_INLINE friend Pack operator-(const Pack& a, const Pack& b) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = a.word[i] - b.word[i];
    return p;
  }
  GLINT_ALWAYS_INLINE friend Pack operator*(const Pack& a, const Pack& b) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = a.word[i] * b.word[i];
    return p;
  }
  GLINT_ALWAYS_INLINE friend Pack operator/(const Pack& a, const Pack& b) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = a.word[i] / b.word[i];
    return p;
  }
  /// The smaller lanes; `b` where either is NaN: the candidate comes first, what is known second.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend Pack min(const Pack& a, const Pack& b) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = a.word[i] < b.word[i] ? a.word[i] : b.word[i];
    return p;
  }
  /// The larger lanes; `b` where either is NaN.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend Pack max(const Pack& a, const Pack& b) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = a.word[i] > b.word[i] ? a.word[i] : b.word[i];
    return p;
  }
  /// The lanes of `then` where a ≤ b, else those of `otherwise`; the latter where either is NaN.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend Pack where_less_equal(const Pack& a, const Pack& b, const Pack& then,
                                                                 const Pack& otherwise) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = a.word[i] <= b.word[i] ? then.word[i] : otherwise.word[i];
    return p;
  }
  /// The same lanes, rounded as written.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend Pack fenced(const Pack& a) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i) p.word[i] = detail::fenced_word(a.word[i]);
    return p;
  }
  /// The lanes of `a` whose bits are set, else those of `b`.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend Pack select(std::uint32_t bits, const Pack& a, const Pack& b) noexcept {
    Pack p;
    for (std::size_t i = 0; i < words; ++i)
      p.word[i] = detail::select_word<T, W>(bits >> (i * std::size_t(W)), a.word[i], b.word[i]);
    return p;
  }
  /// The smallest lane. Requires: no NaN.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend T lowest(const Pack& a) noexcept {
    Word least = a.word[0];
    for (std::size_t i = 1; i < words; ++i) least = a.word[i] < least ? a.word[i] : least;
    return detail::folded_word<T, W>(least, [](const auto& x, const auto& y) { return x < y ? x : y; });
  }
  /// The largest lane. Requires: no NaN.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend T highest(const Pack& a) noexcept {
    Word most = a.word[0];
    for (std::size_t i = 1; i < words; ++i) most = most < a.word[i] ? a.word[i] : most;
    return detail::folded_word<T, W>(most, [](const auto& x, const auto& y) { return x < y ? y : x; });
  }
  /// Each lane rounded toward zero. Requires: all lanes representable.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend std::array<std::int32_t, std::size_t(N)> truncated(const Pack& a) noexcept {
    std::array<std::int32_t, std::size_t(N)> result;
    for (std::size_t i = 0; i < words; ++i) detail::truncate_word<W>(a.word[i], result.data() + i * std::size_t(W));
    return result;
  }
  /// Bit i is set where a[i] ≤ b[i]; clear where either is NaN.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend std::uint32_t less_equal(const Pack& a, const Pack& b) noexcept {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < words; ++i) bits |= detail::lane_bits(a.word[i] <= b.word[i]) << (i * std::size_t(W));
    return bits;
  }
  /// Bit i is set where a[i] < b[i]; clear where either is NaN.
  [[nodiscard]] GLINT_ALWAYS_INLINE friend std::uint32_t less(const Pack& a, const Pack& b) noexcept {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < words; ++i) bits |= detail::lane_bits(a.word[i] < b.word[i]) << (i * std::size_t(W));
    return bits;
  }
};

}  // namespace glint
