// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glint/geometry/ray.hpp>
#include <glint/math/constants.hpp>

#include <peers/contenders.hpp>
#include <support/ray_sets.hpp>
#include <support/timing.hpp>

/// Rays that all contenders answer in turns, and who of them is wrong.
namespace glint::bench {

using Contenders = std::vector<Contender>;

/// Of one contender to all rays of a set: one or the other.
struct Answers {
  std::vector<MaybeHit> hits;
  std::unique_ptr<bool[]> occluded;  ///< not std::vector<bool>, which has no spans
};

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

[[nodiscard]] inline double seconds_of_slice(const Contender& contender, const Measured& measured, Answers& answers,
                                             std::size_t first, std::size_t count) {
  const std::span<const Ray<float>> rays = std::span(measured.set.rays).subspan(first, count);
  return seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
    if (measured.set.question == Question::Closest)
      contender.closest(rays, std::span(answers.hits).subspan(first, count));
    else
      contender.occluded(rays, std::span(answers.occluded.get() + first, count));
  });
}

/// All contenders answer all rays, a slice at a time, each slice by all of them before the next. Who begins changes
/// from slice to slice, and so does the direction of the round.
inline void run_once(const Contenders& contenders, Measured& measured, std::size_t repetition) {
  const std::size_t rays = measured.set.rays.size();
  const std::size_t slice = 1 << 14;
  const std::size_t n = contenders.size();
  for (std::vector<double>& times : measured.times) times.push_back(0);
  for (std::size_t first = 0, turn = repetition; first < rays; first += slice, ++turn) {
    const std::size_t count = std::min(slice, rays - first);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t who = turn / n % 2 == 0 ? (turn + i) % n : (turn + n - i) % n;
      measured.times[who].back() += seconds_of_slice(contenders[who], measured, measured.answers[who], first, count);
    }
  }
}

/// One repetition to warm up, then as many as take every contender long enough.
[[nodiscard]] inline Measured run(const Contenders& contenders, RaySet set, bool quick) {
  Measured measured{std::move(set), Times(contenders.size()), {}};
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const std::size_t rays = measured.set.rays.size();
    measured.answers.push_back({std::vector<MaybeHit>(rays), std::make_unique<bool[]>(rays)});
  }
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

[[nodiscard]] inline bool same(const MaybeHit& a, const MaybeHit& b) {
  if (!a || !b) return !a && !b;
  return a->primitive == b->primitive && std::abs(a->t - b->t) <= 1e-5F * std::abs(a->t);
}

/// How many answers of each contender the judge finds wrong. It is asked where contenders disagree.
template <typename Judge>
void count_wrong(const Contenders& contenders, const Measured& measured, const Judge& judge,
                 std::vector<std::size_t>& wrong) {
  const RaySet& set = measured.set;
  const std::vector<Answers>& answers = measured.answers;
  const bool closest = set.question == Question::Closest;
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    const auto agrees = [&](const Answers& other) {
      return closest ? same(answers[0].hits[i], other.hits[i]) : answers[0].occluded[i] == other.occluded[i];
    };
    if (std::all_of(answers.begin(), answers.end(), agrees)) continue;
    const Ray<float>& ray = set.rays[i];
    for (std::size_t who = 0; who < contenders.size(); ++who) {
      const bool met = answers[who].occluded[i];
      const bool right = closest ? judge.is_right(ray, answers[who].hits[i])
                                 : judge.is_right(ray, met, met ? contenders[who].witness(ray) : std::nullopt);
      wrong[who] += right ? 0U : 1U;
    }
  }
}

}  // namespace glint::bench
