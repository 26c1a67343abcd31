// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_power.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::statics {
namespace {

using Eigen::Index;

int sample_of(const SolidWindow& w, const RollingPair& p) noexcept {
  const int turn = w.harmonics().turn();
  return (p.sample % turn + turn) % turn;
}

/// In the axes of the wheel.
Vec3 force_of(const SolidWindow& w, const SolidRollingSolution& s, std::size_t pair) noexcept {
  const auto row = static_cast<Index>(3 * pair);
  return w.problem().ground.to_wheel({s.force[row], s.force[row + 1], s.force[row + 2]});
}

/// Rows of the candidates of a spectrum.
SolidHarmonics::Block surface_of(const SolidHarmonics& h, const SolidHarmonics::Block& spectrum) {
  SolidHarmonics::Block rows(static_cast<Index>(3 * h.n_candidates()), spectrum.cols());
  for (std::size_t a = 0; a < h.n_candidates(); ++a)
    rows.middleRows<3>(static_cast<Index>(3 * a)) =
        spectrum.middleRows<3>(3 * h.body().candidates[a]);
  return rows;
}

}  // namespace

SolidHarmonics::Block spectrum_of(const SolidWindow& w, const SolidRollingSolution& s) {
  const SolidHarmonics& h = w.harmonics();
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(static_cast<Index>(3 * h.n_candidates()), h.turn());
  for (std::size_t j = 0; j < w.pairs().size(); ++j) {
    const RollingPair& p = w.pairs()[j];
    const Vec3 f = conj(w.frame(p.sample)) * force_of(w, s, j);
    force.block<3, 1>(static_cast<Index>(3 * p.candidate), sample_of(w, p)) << f.x, f.y, f.z;
  }
  return h.spectrum(force, w.gravity());
}

RollingPower rolling_power(const SolidWindow& w, const SolidRollingSolution& s,
                           const SolidHarmonics::Block& spectrum) {
  const SolidHarmonics& h = w.harmonics();
  const double spin = h.body().spin, pass = h.body().samples;
  const SolidHarmonics::Block surface = surface_of(h, spectrum);
  const Eigen::MatrixXd u = h.fields(surface, false), rate = h.fields(surface, true);
  const SolidHarmonics::Damped damped = h.damped(spectrum);
  const double ahead = s.speed * std::cos(s.slip_angle), aside = s.speed * std::sin(s.slip_angle);
  const Vec3 speed = w.problem().ground.to_wheel({0.0, ahead, aside});
  RollingPower power;
  power.mass = damped.by_mass;
  power.stiffness = damped.by_stiffness;
  power.weight = h.weight(spectrum, w.gravity());
  // Of the ground alone: the weight's part is an entry of its own.
  const double torque = s.forces.torque + power.weight / spin;
  power.drive = ahead * s.forces.heading + aside * s.forces.lateral + spin * torque;
  double of_field = 0.0;  // Σ r·w by the field's own velocity
  double turned = 0.0;    // Σ |s x r_n|, of which the torque is what does not cancel
  for (std::size_t j = 0; j < w.pairs().size(); ++j) {
    const RollingPair& p = w.pairs()[j];
    const auto row = static_cast<Index>(3 * j);
    const Vec3 force = force_of(w, s, j);
    if (force == Vec3{}) continue;
    const auto at = static_cast<Index>(3 * p.candidate);
    const Index m = sample_of(w, p);
    const auto of = [&](const Eigen::MatrixXd& field) {
      return Vec3{field(at, m), field(at + 1, m), field(at + 2, m)};
    };
    const Vec3 arm = h.reference(p.candidate) + of(u), change = of(rate);
    const Vec3 way = Vec3{turn90(arm.plane()), 0.0} + change;
    turned += std::abs(spin * s.place[2 * static_cast<Index>(j)] * s.force[row]) / pass;
    of_field += dot(force, spin * (w.frame(p.sample) * way) + speed) / pass;
    power.friction -= s.force.segment<2>(row + 1).dot(s.gap_and_slip.segment<2>(row + 1)) / pass;
  }
  power.scheme = of_field + power.friction;
  const double left = power.drive + power.mass + power.stiffness - power.weight - of_field;
  const double largest =
      std::max({std::abs(ahead * s.forces.heading) + std::abs(aside * s.forces.lateral),
                std::abs(spin * torque), power.mass, power.stiffness, std::abs(power.friction),
                least_power_share * turned});
  power.residual = largest > 0.0 ? std::abs(left) / largest : 0.0;
  find_scheme_shares(s.forces.normal * std::max(std::abs(s.speed), std::abs(spin) * s.height),
                     power);
  return power;
}

}  // namespace rondo::statics
