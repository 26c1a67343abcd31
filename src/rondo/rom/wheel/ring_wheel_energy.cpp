// SPDX-License-Identifier: BSD-3-Clause
/// The ledger of a step: energies at its end, works in it.
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <complex>

#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

}  // namespace

/// Σ aᵀ G b of the filtered forces at both ends of the step.
RingWheel::Products RingWheel::products() const {
  Products sum;
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

/// Work of the ground's forces on the modes in the step.
double RingWheel::work_on_modes() const {
  double power = 0.0;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Modes& s = modes_[h];
    const Index r = s.stiff.size();
    Complexes sum = 0.0;
    for (Index j = 0; j < r; ++j)
      sum +=
          std::conj(s.before[r + j] + s.state[r + j]) * (s.held[j] + settings_.theta * s.force[j]);
    power += 0.5 * harmonics_[h].weight() * sum.real();
  }
  return settings_.dt * ring_.n_sectors() * power;
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

/// What viscous branches of the modes store and take, and the work against the forces of the modes.
void RingWheel::account_branches(WheelEnergy& e) const {
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].strain.account(branches(h), modes_[h].before, modes_[h].state,
                             harmonics_[h].weight() * ring_.n_sectors(), e);
}

/// What the residual of a viscous wheel stores and takes.
RingWheel::Products RingWheel::account_creep(WheelEnergy& e) const {
  const CreepEnergy of = creep_->memory().energy(shares_);
  e.by_residual = of.by_stiffness;
  e.viscous += of.lost - of.by_stiffness;
  e.internal += of.work - of.by_stiffness;
  return {2.0 * of.at_end, 0.0, 2.0 * of.at_start};
}

void RingWheel::account(const WheelMotion& m, WheelReport& report) {
  const double dt = settings_.dt;
  WheelEnergy& e = report.energy;
  account_modes(m, e);
  if (creep_) account_branches(e);
  const double viscous_modes = e.viscous;
  const Products of = creep_ ? account_creep(e) : products();
  e.residual = 0.5 * of.end;
  e.stored += e.residual;
  const double by_table =
      new_table_ && (m.kept_spin || m.spin_rate != 0.0) ? 0.5 * of.start - residual_before_ : 0.0;
  if (!m.kept_spin) e.frame += by_table;
  if (!creep_)
    e.by_residual = settings_.stiffness_damping / dt * (of.end - 2.0 * of.across + of.start);
  e.internal += by_table;
  const Complex back = rotation(m.angle - m.angle_next);  // the force before does not turn on
  const double slides = settings_.slip == SlipRule::bdf2 ? 1.5 : 1.0;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    const GapContact& c = law_[i];
    const Memory& was = memory_of(near.node);
    const double before = dot(tangent_of(touch_[i].normal), back * (near.turn * was.force));
    e.friction -= 0.5 * slides * (before + c.shear) * c.slip;
    if (was.known > 0) e.arrival += c.normal * (was.gap[0] - c.gap);
  }
  e.rim = dot(report.force, m.center_next - m.center) + (m.angle_next - m.angle) * report.torque;
  e.scheme =
      work_on_modes() + 0.5 * (of.end - of.start) + e.by_residual + e.friction + e.arrival + e.rim;
  e.scheme += e.viscous - viscous_modes;
  if (m.kept_spin) e.scheme += by_table;
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
