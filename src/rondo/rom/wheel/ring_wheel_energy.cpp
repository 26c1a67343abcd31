// SPDX-License-Identifier: BSD-3-Clause
/// The ledger of a step: energies at its end, works in it.
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <complex>

#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {

using Eigen::Index;

/// Σ aᵀ G b of the filtered forces at both ends of the step.
ResidualProducts RingWheel::products() const {
  ResidualProducts sum;
  for (const int i : active_) {
    Vec2 now, before;
    for (const int j : active_) {
      const Block& g = beyond(i, j);
      const Memory& from = memory_of(j);
      now += contact::apply(g, from.filtered);
      before += contact::apply(g, from.filtered_before);
    }
    const Memory& to = memory_of(i);
    sum.end += dot(to.filtered, now);
    sum.across += dot(to.filtered, before);
    sum.start += dot(to.filtered_before, before);
  }
  return sum;
}

/// Energy of the modes and what is done to them, but for the forces of the ground.
void RingWheel::account_modes(const WheelMotion& m, WheelEnergy& e) const {
  const double dt = settings_.dt, spin = (m.angle_next - m.angle) / dt;
  const double softened = m.kept_spin ? 0.0 : m.spin_next * m.spin_next;
  const double before = m.spin_next - dt * m.spin_rate;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const double n = of.weight() * ring_.n_sectors();
    for (Index j = 0; j < r; ++j) {
      const Complexes p = 0.5 * (s.before[r + j] + s.state[r + j]);
      const double middle = std::norm(p);
      e.kinetic += 0.5 * n * std::norm(s.state[r + j]);
      e.elastic += 0.5 * n * (of.squares[j] - softened) * std::norm(s.state[j]);
      e.by_mass += n * dt * settings_.mass_damping * middle;
      e.by_stiffness += n * dt * settings_.stiffness_damping * of.squares[j] * middle;
      if (m.kept_spin) continue;  // WheelRim has the works on a rim that moves
      e.frame += n * dt * (std::conj(p) * s.outside[j]).real();
      if (m.spin_rate == 0.0) continue;
      e.frame -= 0.5 * n *
                 ((softened - spin * spin) * std::norm(s.state[j]) +
                  (spin * spin - before * before) * std::norm(s.before[j]));
      for (Index l = 0; l < r; ++l)
        e.frame -= n * dt * m.spin_rate *
                   (std::conj(p) * of.coriolis(j, l) * 0.5 * (s.before[l] + s.state[l])).real();
    }
  }
}

void RingWheel::account(const WheelMotion& m, WheelReport& report) {
  const double dt = settings_.dt;
  WheelEnergy& e = report.energy;
  account_modes(m, e);
  if (creep_) account_branches(e);
  const double viscous_modes = e.viscous;
  const ResidualProducts of = creep_ ? account_creep(creep_->memory(), e) : products();
  if (!creep_)
    e.by_residual = settings_.stiffness_damping / dt * (of.end - 2.0 * of.across + of.start);
  const double by_table = account_residual(m, of, e);
  const Complex back = rotation(m.angle - m.angle_next);  // the force before does not turn on
  const double slides = slip_ == SlipRule::bdf2 ? 1.5 : 1.0;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    const GapContact& c = law_[i];
    const Memory& was = memory_of(near.node);
    const double before = dot(tangent_of(touch_[i].normal), back * (near.turn * was.force));
    e.friction -= 0.5 * slides * (before + c.shear) * c.slip;
    if (was.known > 0) e.arrival += c.normal * (was.gap[0] - c.gap);
  }
  e.rim = dot(report.force, m.center_next - m.center) + (m.angle_next - m.angle) * report.torque;
  e.scheme += e.friction;
  e.scheme += e.arrival;
  e.scheme += e.rim;
  e.scheme += e.viscous - viscous_modes;
  e.scheme += by_table;
}

WheelEnergy RingWheel::energy_at_start(bool softened) const {
  WheelEnergy e;
  const double by_spin = softened ? spin_ * spin_ : 0.0;
  e.residual = e.stored = residual_stored();
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Eigen::VectorXd& squares = harmonics_[h].squares;
    const double n = 0.5 * harmonics_[h].weight() * ring_.n_sectors();
    for (Index j = 0, r = squares.size(); j < r; ++j) {
      e.kinetic += n * std::norm(modes_[h].state[r + j]);
      e.elastic += n * (squares[j] - by_spin) * std::norm(modes_[h].state[j]);
      e.stored += n * squares[j] * std::norm(modes_[h].state[j]);
    }
  }
  return e;
}

}  // namespace rondo::rom
