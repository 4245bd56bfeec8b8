// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <correctness/agreement.hpp>
#include <correctness/bsdf_trials.hpp>
#include <correctness/closed_forms.hpp>
#include <correctness/rows.hpp>

/// Prints, in Markdown, what docs/explanation/correctness.md says; fails where anything is not as it should be.
/// `--quick` takes a fiftieth of the samples.
int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  constexpr double alpha = 0.01;  // the chance that a table of right answers does not hold
  const bool bsdfs = correctness::try_bsdfs(quick ? 1 : 20);
  const bool forms = correctness::print("Closed forms", correctness::closed_forms(quick ? 20'000 : 1'000'000), alpha);
  const bool agreed = correctness::print("Agreement of integrators", correctness::agreement(quick ? 2 : 100), alpha);
  return bsdfs && forms && agreed ? EXIT_SUCCESS : EXIT_FAILURE;
}
