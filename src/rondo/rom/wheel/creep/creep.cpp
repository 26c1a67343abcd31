// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/creep/creep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"

namespace rondo::rom {
namespace {

/// A pole of g, at iω = -rate.
struct CreepPole {
  double modulus = 0.0;
  double rate = 0.0;  ///< 1/τ [1/s]
};

/// Poles with ascending rates; branches of one time are one.
std::vector<CreepPole> poles_of(std::span<const fem::ViscousBranch> branches) {
  std::vector<CreepPole> poles;
  for (const fem::ViscousBranch& b : branches) {
    RONDO_DEMAND(b.relative_modulus > 0.0 && b.time > 0.0, b.relative_modulus, b.time);
    poles.push_back({b.relative_modulus, 1.0 / b.time});
  }
  std::ranges::sort(poles, {}, &CreepPole::rate);
  std::vector<CreepPole> merged;
  for (const CreepPole& p : poles)
    if (!merged.empty() && merged.back().rate == p.rate)
      merged.back().modulus += p.modulus;
    else
      merged.push_back(p);
  return merged;
}

/// g at iω = -x, which falls from each pole to the next one.
double falling(std::span<const CreepPole> poles, double damping, double x) {
  double g = 1.0 - damping * x;
  for (const CreepPole& p : poles) g += p.modulus * x / (x - p.rate);
  return g;
}

/// dg/d(iω) there, > 0.
double slope(std::span<const CreepPole> poles, double damping, double x) {
  double d = damping;
  for (const CreepPole& p : poles) d += p.modulus * p.rate / ((p.rate - x) * (p.rate - x));
  return d;
}

/// The root of g between two rates, by bisection to the last digit.
double root_between(std::span<const CreepPole> poles, double damping, double low, double high) {
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (falling(poles, damping, middle) > 0.0 ? low : high) = middle;
  }
}

}  // namespace

std::vector<CreepTerm> creep_terms(std::span<const fem::ViscousBranch> branches,
                                   double stiffness_damping) {
  RONDO_DEMAND(stiffness_damping >= 0.0, stiffness_damping);
  const std::vector<CreepPole> poles = poles_of(branches);
  std::vector<CreepTerm> terms;
  const auto add = [&](double low, double high) {
    const double x = root_between(poles, stiffness_damping, low, high);
    terms.push_back({1.0 / (x * slope(poles, stiffness_damping, x)), 1.0 / x});
  };
  double low = 0.0;
  for (const CreepPole& p : poles) {
    add(low, p.rate);
    low = p.rate;
  }
  double at_once = 1.0;
  for (const CreepPole& p : poles) at_once += p.modulus;
  if (stiffness_damping > 0.0)
    add(low, low + at_once / stiffness_damping);
  else
    terms.push_back({1.0 / at_once, 0.0});
  std::ranges::reverse(terms);
  return terms;
}

std::complex<double> creep_at(std::span<const CreepTerm> terms, double omega) noexcept {
  std::complex<double> sum;
  for (const CreepTerm& term : terms) sum += term.at(omega);
  return sum;
}

CreepStep creep_step(double time, double dt) noexcept {
  if (!(time > std::numeric_limits<double>::min())) return {};
  const double z = dt / time;
  CreepStep step;
  step.kept = std::exp(-z);
  // 1 - (1 - e^{-z})/z, by its series where that would cancel.
  step.now = z < 0.01
                 ? z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0 - z * (1.0 / 120.0 - z / 720.0))))
                 : 1.0 + std::expm1(-z) / z;
  step.before = -std::expm1(-z) - step.now;
  return step;
}

}  // namespace rondo::rom
