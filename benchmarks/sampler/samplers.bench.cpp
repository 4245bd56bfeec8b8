// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <glint/sampler/halton.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/sampler/sobol.hpp>
#include <glint/sampler/stratified.hpp>
#include <glint/sampler/z_sobol.hpp>

#include <support/bench.hpp>

/// What a number of each sampler costs: paths of 32 draws, one after the other, as in a renderer.
namespace {

using namespace glint;

constexpr int draws = 32;
constexpr int samples = 16;
constexpr int pixels = 256;

/// Says what one draw took, and checks the mean of all numbers: each deviates by √(1/12).
void finish(benchmark::State& state, double sum, double numbers, int draws_made) {
  state.counters["a draw"] =
      benchmark::Counter(draws_made, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  bench::verify(state, std::abs(sum / numbers - 0.5) < 5 * std::sqrt(1.0 / 12 / numbers), "the mean is not 1/2");
}

/// The sum of `count` draws of each path.
template <typename Draw, SampleSequence Q>
double total(const Q& sequence, int count, const Draw& draw) {
  double sum = 0;
  for (int i = 0; i < pixels * samples; ++i) {
    auto sampler = sequence.stream({i / samples % 16, i / samples / 16}, i % samples);
    float path = 0;
    for (int k = 0; k < count; ++k) path += draw(sampler);
    sum += static_cast<double>(path);
  }
  return sum;
}

template <SampleSequence Q>
void singles(benchmark::State& state, const Q& sequence, int count) {
  double sum = 0;
  for (auto _ : state) {
    sum = total(sequence, count, [](auto& sampler) {
      float x = sampler.next_1d();
      benchmark::DoNotOptimize(x);  // or compilers draw several at once, as no renderer can
      return x;
    });
  }
  finish(state, sum, pixels * samples * count, pixels * samples * count);
}

template <SampleSequence Q>
void pairs(benchmark::State& state, const Q& sequence) {
  double sum = 0;
  for (auto _ : state) {
    sum = total(sequence, draws, [](auto& sampler) {
      Vec2<float> p = sampler.next_2d();
      benchmark::DoNotOptimize(p);
      return p.x + p.y;
    });
  }
  finish(state, sum, 2 * pixels * samples * draws, pixels * samples * draws);
}

template <SampleSequence Q>
void add(const std::string& name, const Q& sequence) {
  benchmark::RegisterBenchmark((name + "/number").c_str(), [=](auto& state) { singles(state, sequence, draws); });
  benchmark::RegisterBenchmark((name + "/pair").c_str(), [=](auto& state) { pairs(state, sequence); });
  benchmark::RegisterBenchmark((name + "/stream and number").c_str(),
                               [=](auto& state) { singles(state, sequence, 1); });
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run(argc, argv, [](const bench::Options&) {
    add("independent", Independent{});
    add("stratified", Stratified{.samples_per_pixel = samples});
    add("halton", Halton{});
    add("sobol", Sobol{});
    add("z_sobol", ZSobol{.samples_per_pixel = samples});
  });
}
