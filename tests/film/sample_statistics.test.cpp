// SPDX-License-Identifier: MIT
#include <glint/film/sample_statistics.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

namespace test_film_sample_statistics {

using glint::Rgb;
using glint::SampleStatistics;

TEST_CASE("sample statistics: the variance of the mean of four numbers", "[film][sample_statistics]") {
  SampleStatistics statistics;
  for (const float x : {1.0F, 2.0F, 3.0F, 6.0F}) statistics.add({x, 5, -x});
  CHECK(statistics.count() == 4);
  // The mean is 3, the squares of the distances from it are 4, 1, 0 and 9: 14 / 3 for the samples, 14 / 12 for the
  // mean.
  CHECK(statistics.variance_of_mean() == Rgb{14.0F / 12, 0, 14.0F / 12});
}

TEST_CASE("sample statistics: one sample says nothing of the variance", "[film][sample_statistics]") {
  SampleStatistics statistics;
  CHECK(std::isinf(statistics.variance_of_mean().r));
  statistics.add(Rgb{1});
  CHECK(std::isinf(statistics.variance_of_mean().r));
  statistics.add(Rgb{1});
  CHECK(statistics.variance_of_mean() == Rgb{0});
}

TEST_CASE("sample statistics: small variance around a large mean is not lost", "[film][sample_statistics]") {
  SampleStatistics statistics;
  for (int i = 0; i < 1000; ++i) statistics.add(Rgb{i % 2 == 0 ? 10'000.0F : 10'000.5F});
  // ± 1/4 around the mean: 1/16 · 1000 / 999 for the samples.
  CHECK(statistics.variance_of_mean().g == Approx(1.0 / 16 / 999).epsilon(1e-6));
}

}  // namespace test_film_sample_statistics
