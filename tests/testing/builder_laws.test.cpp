// SPDX-License-Identifier: MIT
#include <glint/testing/builder_laws.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <vector>

#include <glint/bvh/build/median.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>

namespace test_testing_builder_laws {

namespace {

const std::vector<glint::Aabb<float>> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}, {{4, 0, 0}, {5, 1, 1}}};

/// Numbers the slots by the order in which an executor happens to work.
struct InOrderOfWork {
  template <glint::BoundedSet S, glint::Executor E = glint::Serial>
  glint::Tree<float> build(const S& set, const E& executor = {}) const {
    glint::Tree<float> tree = glint::Median{.max_leaf_size = 9}.build(set);
    tree.order.clear();
    executor.parallel_for(set.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) tree.order.push_back(unsigned(i));
    });
    return tree;
  }
};

struct Forgetful {
  template <glint::BoundedSet S, glint::Executor E = glint::Serial>
  glint::Tree<float> build(const S& set, const E& /*executor*/ = {}) const {
    glint::Tree<float> tree = glint::Median{.max_leaf_size = 9}.build(set);
    tree.order.pop_back();
    tree.nodes[0].count -= 1;
    return tree;
  }
};

}  // namespace

TEST_CASE("builder laws: a good builder keeps them", "[testing]") {
  CHECK(glint::testing::violations_of_builder_laws(glint::Median{}, glint::Boxes{boxes}).empty());
}

TEST_CASE("builder laws: a builder that depends on the order of work breaks them", "[testing]") {
  CHECK(glint::testing::violations_of_builder_laws(InOrderOfWork{}, glint::Boxes{boxes}).size() == 1);
}

TEST_CASE("builder laws: a builder that loses a primitive breaks them", "[testing]") {
  CHECK_FALSE(glint::testing::violations_of_builder_laws(Forgetful{}, glint::Boxes{boxes}).empty());
}

}  // namespace test_testing_builder_laws
