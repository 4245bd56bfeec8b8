// SPDX-License-Identifier: MIT
#include <glint/color/tone_curve.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>

namespace test_color_tone_curve {

using glint::Rgb;
using glint::ToneCurve;
using glint::toned;

TEST_CASE("tone curve: black stays black, gray stays gray, and more light is never darker", "[color][tone]") {
  for (const auto& [name, curve] : glint::tone_curves) {
    CAPTURE(name);
    CHECK(toned(Rgb{0}, curve) == Rgb{0});
    float last = 0;
    for (float x = 1e-6F; x < 1e12F; x *= 1.1F) {
      const Rgb shown = toned(Rgb{x}, curve);
      CHECK(shown.r == Approx(shown.g).epsilon(1e-5));
      CHECK(shown.r == Approx(shown.b).epsilon(1e-5));
      CHECK(shown.r >= last * (1 - 1e-5F));  // but for rounding
      last = shown.r;
    }
    CHECK(last >= 0.999F);
    CHECK(std::isfinite(toned(Rgb{std::numeric_limits<float>::max()}, curve).r));
  }
}

TEST_CASE("tone curve: clip changes nothing", "[color][tone]") {
  CHECK(toned({0.25F, 3, -1}, ToneCurve::Clip) == Rgb{0.25F, 3, -1});
}

TEST_CASE("tone curve: filmic has the values of its formula", "[color][tone]") {
  CHECK(glint::filmic_curve(1) == Approx(2.54 / 3.16));                    // (2.51 + 0.03) / (2.43 + 0.59 + 0.14)
  CHECK(glint::filmic_curve(0.1F) == Approx(0.0281 / 0.2233));             // (0.0251 + 0.003) / (0.0243 + 0.059 + 0.14)
  CHECK(glint::filmic_curve(1e6F) == Approx(2.51 / 2.43));                 // the limit
  CHECK(toned({0.1F, 1, -2}, ToneCurve::Filmic).b == 0);                   // below black is black
  CHECK(toned({0.1F, 1, 0}, ToneCurve::Filmic).g == Approx(2.54 / 3.16));  // each channel by itself
}

TEST_CASE("tone curve: Hable's is the published fraction, white at half of 11.2", "[color][tone]") {
  const auto published = [](double x) {
    const double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
  };
  for (const float x : {0.01F, 0.18F, 1.0F, 4.0F}) {
    CHECK(glint::hable_curve(x) == Approx(published(2 * static_cast<double>(x)) / published(11.2)));
  }
  CHECK(glint::hable_curve(5.6F) == Approx(1));
}

TEST_CASE("tone curve: AgX keeps middle gray, and reaches black and white at the ends of its range", "[color][tone]") {
  CHECK(glint::agx_curve(0.18F) == Approx(0.18));
  CHECK(glint::agx_curve(0.18F * 0x1p-10F) == Approx(0).margin(1e-6));
  CHECK(glint::agx_curve(0.18F * 0x1p-12F) == Approx(0).margin(1e-6));
  CHECK(glint::agx_curve(0.18F * std::exp2(6.5F)) == Approx(1));
  CHECK(glint::agx_curve(1e9F) == Approx(1));
  // Near middle gray 2.4 · stops / 16.5 are added to what a display of gamma 2.4 gets.
  const double stops = 0.01;
  const double shown = std::pow(0.18, 1 / 2.4) + 2.4 * stops / 16.5;
  CHECK(glint::agx_curve(static_cast<float>(0.18 * std::exp2(stops))) == Approx(std::pow(shown, 2.4)).epsilon(1e-4));
}

TEST_CASE("tone curve: AgX turns bright colors white, and leaves dim ones colored", "[color][tone]") {
  const Rgb bright = toned({1e6F, 1, 0}, ToneCurve::Agx);
  CHECK(bright.b > 0.99F);
  const Rgb dim = toned({0.2F, 0.02F, 0.02F}, ToneCurve::Agx);
  CHECK(dim.r > 2 * dim.g);
  CHECK(dim.g == dim.b);
}

}  // namespace test_color_tone_curve
