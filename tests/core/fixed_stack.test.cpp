// SPDX-License-Identifier: MIT
#include <glint/core/fixed_stack.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_core_fixed_stack {

TEST_CASE("fixed stack: the last in is the first out, to its capacity", "[core]") {
  glint::FixedStack<int, 3> stack;
  CHECK(stack.empty());
  for (const int i : {1, 2, 3}) stack.push(i);
  CHECK(stack.size() == 3);
  stack[1] = 7;
  CHECK(stack.pop() == 3);
  CHECK(stack.pop() == 7);
  CHECK(stack.pop() == 1);
  CHECK(stack.empty());
}

}  // namespace test_core_fixed_stack
