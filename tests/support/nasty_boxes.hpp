// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/math/constants.hpp>
#include <glint/testing/builder_laws.hpp>

#include <support/catch.hpp>

namespace glint::testing {

/// Two threads at a time, ranges cut in the middle: a race shows itself here, under a thread sanitizer for sure.
struct TwoThreads {
  [[nodiscard]] static int concurrency() noexcept { return 2; }

  template <typename Body>
  static void parallel_for(std::size_t n, std::size_t grain, Body&& body) {
    if (n < 2 * grain) return Serial::parallel_for(n, grain, body);
    invoke([&] { body(std::size_t{0}, n / 2); }, [&] { body(n / 2, n); });
  }
  template <typename F, typename G>
  static void invoke(F&& f, G&& g) {
    std::exception_ptr error;
    std::thread other([&] {
      try {
        g();
      } catch (...) {
        error = std::current_exception();
      }
    });
    f();
    other.join();
    if (error) std::rethrow_exception(error);
  }
};

template <typename T>
[[nodiscard]] std::vector<Aabb<T>> random_boxes(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return T(random()) * T(0x1p-32); };
  std::vector<Aabb<T>> boxes(n);
  for (Aabb<T>& box : boxes) {
    const T x = uniform();
    const T y = uniform();
    const T z = uniform();
    box.lower = {x, y, z};
    box.upper = box.lower + Vec3<T>(uniform() * T(0.1));
  }
  return boxes;
}

/// Sets of boxes that have broken builders: each with a name.
template <typename T>
[[nodiscard]] std::vector<std::pair<std::string, std::vector<Aabb<T>>>> nasty_boxes() {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  constexpr T huge = std::numeric_limits<T>::max();
  const Aabb<T> unit{Vec3<T>(T(0)), Vec3<T>(T(1))};
  std::vector<std::pair<std::string, std::vector<Aabb<T>>>> sets{
      {"none", {}},
      {"one", {unit}},
      {"two", {unit, {Vec3<T>(T(2)), Vec3<T>(T(3))}}},
      {"none with a box", {Aabb<T>{}, {Vec3<T>(nan), Vec3<T>(T(1))}, {Vec3<T>(T(0)), Vec3<T>(infinity<T>)}}},
      {"some with a box", {Aabb<T>{}, unit, {Vec3<T>(nan), Vec3<T>(T(1))}, unit, {Vec3<T>(-infinity<T>), {}}, unit}},
      {"as large as there are",
       {{Vec3<T>(-huge), Vec3<T>(huge)},
        unit,
        {Vec3<T>(huge), Vec3<T>(huge)},
        unit,
        unit,
        {Vec3<T>(-huge), Vec3<T>(-huge)},
        unit,
        unit,
        unit,
        unit}},
      {"equal", std::vector<Aabb<T>>(1000, unit)},
      {"equal points", std::vector<Aabb<T>>(100, {Vec3<T>(T(3)), Vec3<T>(T(3))})},
      {"random", random_boxes<T>(500, 1)}};
  std::vector<Aabb<T>> nested;
  std::vector<Aabb<T>> spaced;
  std::vector<Aabb<T>> tiny;
  for (int i = 0; i < 200; ++i) {
    nested.push_back({Vec3<T>(-T(i)), Vec3<T>(T(i))});
    const T x = std::ldexp(T(1), 100 - i);  // each an axis of its own: halving the space takes off one
    spaced.push_back({{x, T(0), T(0)}, {x, T(0), T(0)}});
    tiny.push_back({{T(1), T(1), std::numeric_limits<T>::denorm_min() * T(i)}, {T(1), T(1), T(1)}});
  }
  sets.emplace_back("nested", nested);
  sets.emplace_back("exponentially spaced", spaced);
  sets.emplace_back("closer than numbers can tell", tiny);
  return sets;
}

template <typename T, typename Builder>
void check_builder(T /*scalar*/, const Builder& builder) {
  for (const auto& [name, boxes] : nasty_boxes<T>()) {
    CAPTURE(name);
    for (const std::string& broken : violations_of_builder_laws(builder, Boxes{boxes})) FAIL_CHECK(broken);
  }
}

/// 100 000 boxes: more than builders handle in one piece, some of them without a finite box.
template <typename Builder>
void check_large_builds(const Builder& builder) {
  auto boxes = random_boxes<float>(100'000, 2);
  for (std::size_t i = 0; i < boxes.size(); i += 1001) boxes[i] = {};
  for (const std::string& broken : violations_of_builder_laws(builder, Boxes{boxes})) FAIL_CHECK(broken);
  CHECK(builder.build(Boxes{boxes}, TwoThreads{}) == builder.build(Boxes{boxes}));
  const std::vector<Aabb<float>> same(100'000, {{0, 0, 0}, {1, 1, 1}});
  for (const std::string& broken : violations_of_builder_laws(builder, Boxes{same})) FAIL_CHECK(broken);
}

/// Boxes that make a surface area heuristic take off one at a time, in trees of every depth.
template <typename MakeBuilder>
void check_depth(const MakeBuilder& make_builder) {
  std::vector<Aabb<float>> boxes;
  for (int i = 0; i < 230; ++i) {
    const float x = std::ldexp(1.0F, 100 - i);
    boxes.push_back({{0, 0, 0}, {x, x, x}});
  }
  for (const int depth : {0, 1, 2, 7, 8, 20, 64, 99}) {
    CAPTURE(depth);
    const auto tree = make_builder(depth).build(Boxes{boxes});
    CHECK(tree.depth <= std::min(depth, tree.max_depth));
    CHECK(violations(tree, Boxes{boxes}).empty());
  }
}

}  // namespace glint::testing
