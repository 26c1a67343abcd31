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
RingWheel::Products RingWheel::products(const RingResidual& table) const {
  Products sum;
  for (const int i : active_)
    for (const int j : active_) {
      const Memory &to = memory_of(i), &from = memory_of(j);
      const Block g = answer(table.blocks.data(), i, j);
      const Vec2 now = contact::apply(g, from.filtered),
                 before = contact::apply(g, from.filtered_before);
      sum.end += dot(to.filtered, now);
      sum.across += dot(to.filtered, before);
      sum.start += dot(to.filtered_before, before);
    }
  return sum;
}

/// Work of the forces at one end of a step on the mean velocity of the modes, over Δt.
double RingWheel::work_on_modes(double angle, bool at_end) const {
  const Complex rotation = turned_by(angle);
  double power = 0.0;
  const auto add = [&](int node, Vec2 force) {
    const Complex turn = rotation * ring_.stiffness.turn[at(sector(node))];
    const Index c = Index{2} * (node % n_contact_);
    for_waves(harmonics_, turn, [&](std::size_t h, Complex wave) {
      const std::complex<double>* rate = modes_[h].middle.data() + c;
      power += harmonics_[h].weight() *
               (real_product(wave, rate[0]) * force.x + real_product(wave, rate[1]) * force.y);
    });
  };
  if (at_end) {
    for (const WheelContact& c : contacts_)
      add(c.node, conj(rotation * ring_.stiffness.turn[at(sector(c.node))]) * c.force);
  } else {
    for (const Near& near : near_)
      if (memory_of(near.node).force != Vec2{}) add(near.node, memory_of(near.node).force);
  }
  return power;
}

/// Energy of the modes and what is done to them, but for the forces of the ground.
void RingWheel::account_modes(const WheelMotion& m, WheelEnergy& e) const {
  const double dt = settings_.dt, spin = (m.angle_next - m.angle) / dt;
  const double softened = m.spin_next * m.spin_next;
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
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const Index r = harmonics_[h].squares.size();
    s.work.head(r) = 0.5 * (s.before.tail(r) + s.state.tail(r));
    s.middle.noalias() = harmonics_[h].contact * s.work.head(r);
  }
  account_modes(m, e);
  const Products of = products(table_);
  e.residual = 0.5 * of.end;
  if (m.spin_rate != 0.0) e.frame += 0.5 * (of.start - products(table_before_).start);
  e.by_residual = settings_.stiffness_damping / dt * (of.end - 2.0 * of.across + of.start);
  const double slides = settings_.slip == SlipRule::bdf2 ? 1.5 : 1.0;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    const GapContact& c = law_[i];
    const Memory& was = memory_of(near.node);
    const double before = dot(tangent_of(touch_[i].normal), near.turn * was.force);
    e.friction -= 0.5 * slides * (before + c.shear) * c.slip;
    if (was.known > 0) e.arrival += c.normal * (was.gap[0] - c.gap);
  }
  e.rim = dot(report.force, m.center_next - m.center) + (m.angle_next - m.angle) * report.torque;
  const double work = dt * (settings_.theta * work_on_modes(m.angle_next, true) +
                            (1.0 - settings_.theta) * work_on_modes(m.angle, false));
  e.scheme = work + 0.5 * (of.end - of.start) + e.by_residual + e.friction + e.arrival + e.rim;
}

WheelEnergy RingWheel::energy_at_start() const {
  WheelEnergy e;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Eigen::VectorXd& squares = harmonics_[h].squares;
    const double n = 0.5 * harmonics_[h].weight() * ring_.n_sectors();
    for (Index j = 0, r = squares.size(); j < r; ++j) {
      e.kinetic += n * std::norm(modes_[h].state[r + j]);
      e.elastic += n * (squares[j] - spin_ * spin_) * std::norm(modes_[h].state[j]);
    }
  }
  return e;
}

}  // namespace rondo::rom
