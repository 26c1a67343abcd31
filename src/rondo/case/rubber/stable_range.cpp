// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/rubber/stable_range.hpp"

#include <cmath>

namespace rondo::study {
namespace {

/// f(λ) = λ₁^q + λ₂^q + λ₃^q - 3: I₁ - 3 for q = 2, the incompressible I₂ - 3 for q = -2.
struct PowerSum {
  double value = -3.0, slope = 0.0, curvature = 0.0;
};

PowerSum power_sum(double q, const double (&powers)[3], double stretch) noexcept {
  PowerSum sum;
  for (const double power : powers) {
    const double p = q * power, term = std::pow(stretch, p);
    sum.value += term;
    sum.slope += p * term / stretch;
    sum.curvature += p * (p - 1.0) * term / (stretch * stretch);
  }
  return sum;
}

struct Test {
  std::string_view name;
  double powers[3];  ///< exponents of the three principal stretches
};

constexpr Test tests[] = {{"uniaxial", {1.0, -0.5, -0.5}},
                          {"equibiaxial", {1.0, 1.0, -2.0}},
                          {"planar", {1.0, 0.0, -1.0}}};

}  // namespace

double stress_slope(const fem::Rubber& r, const double (&powers)[3], double stretch) noexcept {
  double curvature = 0.0;
  if (r.law == fem::RubberLaw::ogden) {
    for (const fem::OgdenTerm& t : r.terms)
      curvature += t.modulus / t.exponent * power_sum(t.exponent, powers, stretch).curvature;
    return curvature;
  }
  const PowerSum i1 = power_sum(2.0, powers, stretch), i2 = power_sum(-2.0, powers, stretch);
  const double by_i1 = r.c10 + (2.0 * r.c20 + 3.0 * r.c30 * i1.value) * i1.value;
  const double by_i1_twice = 2.0 * r.c20 + 6.0 * r.c30 * i1.value;
  return by_i1 * i1.curvature + by_i1_twice * i1.slope * i1.slope + r.c01 * i2.curvature;
}

std::optional<Unstable> find_unstable(const fem::Rubber& rubber) {
  constexpr int parts = 200;
  const double ends[] = {std::log(largest_stretch), std::log(least_stretch)};
  for (int k = 0; k <= parts; ++k)  // outwards from stretch 1
    for (const Test& test : tests)
      for (const double end : ends) {
        const double stretch = std::exp(end * k / parts);
        if (!(stress_slope(rubber, test.powers, stretch) > 0.0))
          return Unstable{test.name, stretch};
      }
  return std::nullopt;
}

}  // namespace rondo::study
