// SPDX-License-Identifier: MIT
#include <glint/core/hash.hpp>  // first, so the header proves it stands alone

#include <bit>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <support/catch.hpp>

namespace test_core_hash {

using glint::hash_bytes;

TEST_CASE("hash: a sequence, its prefixes, and those that differ from it in one bit, all have hashes of their own",
          "[core][hash]") {
  std::vector<std::byte> bytes(100);
  for (std::size_t i = 0; i != bytes.size(); ++i) bytes[i] = std::byte(i * 37 % 256);
  std::set<std::uint64_t> seen;
  std::size_t count = 0;
  for (std::size_t size = 0; size <= bytes.size(); ++size, ++count)
    seen.insert(hash_bytes(std::span(bytes).first(size)));
  for (std::size_t bit = 0; bit != 8 * bytes.size(); ++bit, ++count) {
    bytes[bit / 8] ^= std::byte(1U << (bit % 8));
    seen.insert(hash_bytes(bytes));
    bytes[bit / 8] ^= std::byte(1U << (bit % 8));
  }
  CHECK(seen.size() == count);
}

TEST_CASE("hash: zeros are told apart by how many there are, and words by their order", "[core][hash]") {
  std::set<std::uint64_t> seen;
  for (std::size_t size = 0; size != 200; ++size) seen.insert(hash_bytes(std::vector<std::byte>(size)));
  CHECK(seen.size() == 200);
  const std::vector<std::uint64_t> forward{1, 2, 3, 4, 5, 6, 7, 8};
  for (std::size_t i = 0; i + 1 != forward.size(); ++i) {
    std::vector<std::uint64_t> swapped = forward;
    std::swap(swapped[i], swapped[i + 1]);
    CHECK(glint::hash_values(std::span<const std::uint64_t>(swapped)) !=
          glint::hash_values(std::span<const std::uint64_t>(forward)));
  }
}

TEST_CASE("hash: a flipped bit flips about half of the hash's", "[core][hash]") {
  // 512 flips of 64 fair bits each: the mean is 32 with a deviation of 4 / √512 ≈ 0.18.
  std::vector<std::byte> bytes(64);
  const std::uint64_t original = hash_bytes(bytes);
  int changed = 0;
  for (std::size_t bit = 0; bit != 512; ++bit) {
    bytes[bit / 8] ^= std::byte(1U << (bit % 8));
    changed += std::popcount(original ^ hash_bytes(bytes));
    bytes[bit / 8] ^= std::byte(1U << (bit % 8));
  }
  CHECK(changed / 512.0 == Approx(32).margin(1));
}

TEST_CASE("hash: the seed counts, as does what was hashed before", "[core][hash]") {
  const std::vector<std::byte> bytes(40);
  CHECK(hash_bytes(bytes, 1) != hash_bytes(bytes, 2));
  CHECK(hash_bytes({}, 1) != hash_bytes({}, 2));
  CHECK(hash_bytes(bytes, hash_bytes(bytes)) != hash_bytes(bytes));
}

}  // namespace test_core_hash
