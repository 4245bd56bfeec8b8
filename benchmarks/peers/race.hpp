// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glint/core/index.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/math/constants.hpp>

#include <peers/contenders.hpp>
#include <peers/judge.hpp>
#include <peers/ray_sets.hpp>
#include <peers/timing.hpp>

/// Rays that all contenders answer in turns, and who of them is wrong.
namespace glint::bench {

using Contenders = std::vector<Contender>;
using Answers = std::vector<Hit<float>>;

/// Seconds of each repetition, for each contender.
using Times = std::vector<std::vector<double>>;

struct Measured {
  RaySet set;
  Times times;
  std::vector<Answers> answers;  ///< of each contender
};

[[nodiscard]] inline bool is_ours(const Contender& c) {
  return !c.like.empty();
}

/// All contenders answer all rays, a slice at a time, each slice by all of them before the next. Who begins changes
/// from slice to slice, and so does the direction of the round.
inline void run_once(const Contenders& contenders, Measured& measured, std::size_t repetition) {
  const std::span<const Ray<float>> rays = measured.set.rays;
  const std::size_t slice = 1 << 14;
  const std::size_t n = contenders.size();
  for (std::vector<double>& times : measured.times) times.push_back(0);
  for (std::size_t first = 0, turn = repetition; first < rays.size(); first += slice, ++turn) {
    const std::size_t count = std::min(slice, rays.size() - first);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t who = turn / n % 2 == 0 ? (turn + i) % n : (turn + n - i) % n;
      const std::span answers = std::span(measured.answers[who]).subspan(first, count);
      measured.times[who].back() += seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
        contenders[who].answer(measured.set.question, rays.subspan(first, count), answers);
      });
    }
  }
}

/// One repetition to warm up, then as many as take every contender long enough.
[[nodiscard]] inline Measured run(const Contenders& contenders, RaySet set, bool quick) {
  Measured measured{std::move(set), Times(contenders.size()), {}};
  measured.answers.assign(contenders.size(), Answers(measured.set.rays.size(), Hit<float>{.t = infinity<float>}));
  if (measured.set.rays.empty())
    throw std::runtime_error("no ray of the set '" + measured.set.name + "' starts anywhere");
  run_once(contenders, measured, 0);
  double shortest = infinity<double>;
  for (std::vector<double>& times : measured.times) {
    shortest = std::min(shortest, times.back());
    times.clear();
  }
  const int rounds = quick ? 1 : std::max(1, int(std::ceil(0.02 / shortest)));
  for (std::size_t repetition = 0; repetition < (quick ? 3U : 9U); ++repetition) {
    std::vector<double> sums(contenders.size());
    for (int round = 0; round < rounds; ++round) {
      run_once(contenders, measured, repetition);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] += measured.times[i].back();
        measured.times[i].pop_back();
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) measured.times[i].push_back(sums[i] / rounds);
  }
  return measured;
}

[[nodiscard]] inline double mega_rays(const Measured& measured, std::size_t contender) {
  return 1e-6 * double(measured.set.rays.size()) / median(measured.times[contender]);
}

/// How many answers of each contender the judge finds wrong. It is asked where contenders disagree.
inline void count_wrong(const Contenders& contenders, const Measured& measured, const Judge& judge,
                        std::vector<std::size_t>& wrong) {
  const RaySet& set = measured.set;
  const std::vector<Answers>& answers = measured.answers;
  const auto same = [&](const Hit<float>& a, const Hit<float>& b) {
    if (a.primitive != b.primitive) return false;
    return set.question == Question::Occluded || a.t == b.t || std::abs(a.t - b.t) <= 1e-5F * std::abs(a.t);
  };
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    const auto agrees = [&](const Answers& other) { return same(answers[0][i], other[i]); };
    if (std::all_of(answers.begin(), answers.end(), agrees)) continue;
    for (std::size_t who = 0; who < contenders.size(); ++who) {
      const Hit<float>& hit = answers[who][i];
      const bool met = hit.primitive != none<std::uint32_t>;
      const bool right =
          set.question == Question::Closest
              ? judge.is_right(set.rays[i], met ? std::optional(hit) : std::nullopt)
              : judge.is_right(set.rays[i], met, met ? contenders[who].witness(set.rays[i]) : std::nullopt);
      wrong[who] += right ? 0U : 1U;
    }
  }
}

}  // namespace glint::bench
