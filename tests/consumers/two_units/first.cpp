// SPDX-License-Identifier: MIT
#include "hits.hpp"

const glint::Version* version_in_second_unit();
int hits_in_second_unit();

/// One program, one version object: an `inline` forgotten in a header would end in duplicates here, or at the linker.
/// And both units trace right, though each has other vector registers.
int main() {
  if (version_in_second_unit() != &glint::version) return 1;
  if (hits_in_this_unit() != 400) return 2;
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 0;
#endif
  return hits_in_second_unit() == 400 ? 0 : 3;
}
