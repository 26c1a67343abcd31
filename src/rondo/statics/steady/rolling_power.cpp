// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_power.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::statics {
namespace {

using Eigen::Index;

int sample_of(const RollingWindow& w, const RollingPair& p) noexcept {
  const int turn = w.harmonics().turn();
  return (p.sample % turn + turn) % turn;
}

/// A scheme below this share of load times speed is round-off.
constexpr double round_off = 1e-12;

}  // namespace

void find_scheme_shares(double carried, RollingPower& p) noexcept {
  const double scheme = std::abs(p.scheme);
  if (!(scheme > round_off * carried)) return;
  const double largest = std::max({std::abs(p.drive), p.mass + p.stiffness, std::abs(p.friction)});
  p.scheme_share = scheme / largest;
  p.scheme_over_load = scheme / carried;
}

RollingHarmonics::Block spectrum_of(const RollingWindow& w, const RollingSolution& s) {
  const RollingHarmonics& h = w.harmonics();
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(static_cast<Index>(2 * h.n_candidates()), h.turn());
  for (std::size_t j = 0; j < w.pairs().size(); ++j) {
    const RollingPair& p = w.pairs()[j];
    const auto row = static_cast<Index>(2 * j);
    const Vec2 f = conj(w.frame(p.sample)) * Vec2{s.force[row + 1], s.force[row]};
    force.block<2, 1>(static_cast<Index>(2 * p.candidate), sample_of(w, p)) << f.x, f.y;
  }
  return h.spectrum(force);
}

RollingPower rolling_power(const RollingWindow& w, const RollingSolution& s,
                           const RollingHarmonics::Block& spectrum) {
  const RollingHarmonics& h = w.harmonics();
  const double spin = h.body().spin, pass = h.body().samples;
  const Index first = 2 * *std::ranges::min_element(h.body().candidates);  // all are beyond it
  const auto surface = spectrum.bottomRows(spectrum.rows() - first);
  const Eigen::MatrixXd u = h.fields(surface, 0.0, false), rate = h.fields(surface, 0.0, true);
  const RollingHarmonics::Damped damped = h.damped(spectrum);
  RollingPower power;
  power.mass = damped.by_mass;
  power.stiffness = damped.by_stiffness;
  power.weight = h.weight(spectrum);
  // Of the ground alone: the weight's part is an entry of its own.
  const double torque = s.forces.torque + power.weight / spin;
  power.drive = s.speed * s.forces.x + spin * torque;
  double of_field = 0.0;  // Σ r·w by the field's own velocity
  double turned = 0.0;    // Σ |s x r_n|, of which the torque is what does not cancel
  for (std::size_t j = 0; j < w.pairs().size(); ++j) {
    const RollingPair& p = w.pairs()[j];
    const auto row = static_cast<Index>(2 * j);
    const Vec2 force{s.force[row + 1], s.force[row]};
    if (force == Vec2{}) continue;
    const int row_of = h.body().candidates[p.candidate];
    const Index node = 2 * row_of - first, m = sample_of(w, p);
    const Vec2 x = h.body().reference[h.body().stiffness.node(static_cast<std::size_t>(row_of), 0)];
    const Vec2 arm = x + Vec2{u(node, m), u(node + 1, m)};
    const Vec2 way = turn90(arm) + Vec2{rate(node, m), rate(node + 1, m)};
    const Vec2 velocity = spin * (w.frame(p.sample) * way) + Vec2{s.speed, 0.0};
    of_field += dot(force, velocity) / pass;
    turned += std::abs(spin * (w.frame(p.sample) * arm).x * force.y) / pass;
    power.friction -= force.x * s.gap_and_slip[row + 1] / pass;
  }
  power.scheme = of_field + power.friction;
  const double left = power.drive + power.mass + power.stiffness - power.weight - of_field;
  const double largest =
      std::max({std::abs(s.speed * s.forces.x), std::abs(spin * torque), power.mass,
                power.stiffness, std::abs(power.friction), least_power_share * turned});
  power.residual = largest > 0.0 ? std::abs(left) / largest : 0.0;
  find_scheme_shares(s.forces.y * std::max(std::abs(s.speed), std::abs(spin) * s.height), power);
  return power;
}

}  // namespace rondo::statics
