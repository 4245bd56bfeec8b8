// SPDX-License-Identifier: MIT
#include <glint/core/strided.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <support/catch.hpp>

namespace test_core_strided {

namespace {

struct Vertex {
  std::uint8_t tag = 0;
  std::array<float, 3> position{};
  std::array<float, 2> uv{};
};

}  // namespace

TEST_CASE("strided: reads a member of each element of an array", "[core][strided]") {
  const std::vector<Vertex> vertices{{1, {1, 2, 3}, {4, 5}}, {2, {6, 7, 8}, {9, 10}}};
  const auto positions = glint::strided_member(std::span(vertices), &Vertex::position);
  REQUIRE(positions.size() == 2);
  CHECK(positions.stride() == sizeof(Vertex));
  CHECK(positions[0] == std::array<float, 3>{1, 2, 3});
  CHECK(positions[1] == std::array<float, 3>{6, 7, 8});
  CHECK(positions.at(1) == reinterpret_cast<const std::byte*>(&vertices[1].position));
  CHECK(glint::strided_member(std::span<const Vertex>(), &Vertex::uv).empty());
}

TEST_CASE("strided: a vector is a tightly packed view", "[core][strided]") {
  const std::vector<int> values{3, 1, 4};
  const glint::Strided<int> all = values;
  REQUIRE(all.size() == 3);
  CHECK(all[0] == 3);
  CHECK(all[2] == 4);
  CHECK(glint::Strided<int>().empty());
}

TEST_CASE("strided: values need no alignment", "[core][strided]") {
  std::array<std::byte, 2 * 7 + 1> raw{};
  const double first = 1.5;
  const float second = -2.5F;
  std::memcpy(raw.data() + 1, &second, sizeof(second));
  std::memcpy(raw.data() + 8, &second, sizeof(second));
  const glint::Strided<float> floats(raw.data() + 1, 2, 7);
  CHECK(floats[0] == second);
  CHECK(floats[1] == second);
  std::memcpy(raw.data() + 3, &first, sizeof(first));
  CHECK(glint::Strided<double>(raw.data() + 3, 1)[0] == first);
}

TEST_CASE("strided: triples are read from flat indices of either width", "[core][strided]") {
  const std::vector<std::uint16_t> flat{0, 1, 2, 2, 1, 3};
  const glint::Strided<std::array<std::uint16_t, 3>> triples(flat.data(), flat.size() / 3);
  REQUIRE(triples.size() == 2);
  CHECK(triples[1] == std::array<std::uint16_t, 3>{2, 1, 3});
}

}  // namespace test_core_strided
