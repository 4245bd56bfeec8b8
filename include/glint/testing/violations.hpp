// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glint/geometry/ray.hpp>
#include <glint/math/vec.hpp>

namespace glint::testing {

/// Collects what is broken: one sentence a law, with the first ray that broke it.
class Violations {
 public:
  template <std::floating_point T>
  void expect(bool kept, const char* law, const Ray<T>& ray) {
    if (kept || is_known(law)) return;
    std::ostringstream text;
    text.precision(std::numeric_limits<T>::max_digits10);
    text << law << ": broken for the ray from (" << ray.origin.x << ", " << ray.origin.y << ", " << ray.origin.z
         << ") along (" << ray.direction.x << ", " << ray.direction.y << ", " << ray.direction.z << "), t in ["
         << ray.t_min << ", " << ray.t_max << ']';
    add(law, text.str());
  }

  /// For laws about many rays at once.
  void expect(bool kept, const char* law, double measured, double expected) {
    if (kept || is_known(law)) return;
    std::ostringstream text;
    text << law << ": measured " << measured << ", expected " << expected;
    add(law, text.str());
  }

  /// For laws about a pair of directions.
  void expect(bool kept, const char* law, const Vec3<float>& wo, const Vec3<float>& wi) {
    if (kept || is_known(law)) return;
    std::ostringstream text;
    text.precision(std::numeric_limits<float>::max_digits10);
    text << law << ": broken for wo = (" << wo.x << ", " << wo.y << ", " << wo.z << "), wi = (" << wi.x << ", " << wi.y
         << ", " << wi.z << ')';
    add(law, text.str());
  }

  /// For laws whose check tells what it found.
  void expect(bool kept, const char* law, const std::string& what) {
    if (kept || is_known(law)) return;
    add(law, law + (": " + what));
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(sentences_); }

 private:
  [[nodiscard]] bool is_known(const char* law) const {
    return std::find(laws_.begin(), laws_.end(), law) != laws_.end();
  }
  void add(const char* law, std::string sentence) {
    laws_.emplace_back(law);
    sentences_.push_back(std::move(sentence));
  }

  std::vector<std::string> laws_;
  std::vector<std::string> sentences_;
};

}  // namespace glint::testing
