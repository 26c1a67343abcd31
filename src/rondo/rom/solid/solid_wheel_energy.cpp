// SPDX-License-Identifier: BSD-3-Clause
/// The ledger of a step: energies at its end, works in it.
#include <complex>

#include "rondo/core/index.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

}  // namespace

/// Energy of the residual at the end of the last step.
double SolidWheel::residual_stored() const {
  if (creep_) return creep_->memory().stored(shares_);
  double sum = 0.0;
  for (const int node : seen_) sum += dot(memory_of(node).filtered, memory_of(node).residual);
  return 0.5 * sum;
}

/// Work on the modes of the inertia that a turning hub causes.
double SolidWheel::work_of_turning(const SolidMotion& motion) const {
  const WheelMotion& m = motion.plane;
  const double spin = (m.angle_next - m.angle) / settings_.dt;
  const Complexes tilting = motion.tilting(spin);
  double power = 0.0;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    if (of.k != 1) continue;
    const Index r = of.squares.size();
    const auto middle = 0.5 * (modes_[h].before.tail(r) + modes_[h].state.tail(r));
    power -= of.weight() * (tilting * middle.dot(of.tilt)).real();
  }
  return settings_.dt * ring_.n_sectors() * power;
}

/// Energy of the modes and what is done to them, but for the forces of the ground.
void SolidWheel::account_modes(const SolidMotion& motion, SolidWheelReport& report) const {
  WheelEnergy& e = report.energy;
  const WheelMotion& m = motion.plane;
  const double dt = settings_.dt, spin = (m.angle_next - m.angle) / dt;
  const double softened = m.kept_spin ? 0.0 : m.spin_next * m.spin_next;
  const double before = m.spin_next - dt * m.spin_rate;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const double n = of.weight() * ring_.n_sectors();
    Complexes planar = 0.0, planar_before = 0.0, turned = 0.0;
    for (Index j = 0; j < r; ++j) {
      const Complexes p = 0.5 * (s.before[r + j] + s.state[r + j]);
      const double middle = std::norm(p);
      e.kinetic += 0.5 * n * std::norm(s.state[r + j]);
      e.elastic += 0.5 * n * of.squares[j] * std::norm(s.state[j]);
      e.by_mass += n * dt * settings_.mass_damping * middle;
      e.by_stiffness += n * dt * settings_.stiffness_damping * of.squares[j] * middle;
      const double load = n * dt * (std::conj(p) * of.load[j]).real();
      report.load += load;
      if (!m.kept_spin) e.frame += n * dt * (std::conj(p) * s.outside[j]).real() - load;
      for (Index l = 0; l < r; ++l) {
        planar += std::conj(s.state[j]) * of.planar(j, l) * s.state[l];
        planar_before += std::conj(s.before[j]) * of.planar(j, l) * s.before[l];
        turned += std::conj(p) * of.coriolis(j, l) * 0.5 * (s.before[l] + s.state[l]);
      }
    }
    e.elastic -= 0.5 * n * softened * planar.real();
    if (m.kept_spin || m.spin_rate == 0.0) continue;  // WheelRim has the works on a rim that moves
    e.frame -= 0.5 * n *
               ((softened - spin * spin) * planar.real() +
                (spin * spin - before * before) * planar_before.real());
    e.frame -= n * dt * m.spin_rate * turned.real();
  }
}

/// Sums the products of the filtered forces on the near nodes.
ResidualProducts SolidWheel::products() const {
  ResidualProducts sum;
  for (const Near& near : near_) {
    const Memory& memory = memory_of(near.node);
    sum.end += dot(memory.filtered, memory.residual);
    sum.across += dot(memory.filtered, memory.residual_before);
    sum.start += dot(memory.filtered_before, memory.residual_before);
  }
  return sum;
}

void SolidWheel::account(const SolidMotion& motion, SolidWheelReport& report) {
  const WheelMotion& m = motion.plane;
  const double dt = settings_.dt;
  WheelEnergy& e = report.energy;
  account_modes(motion, report);
  if (creep_) account_branches(e);
  const double viscous_modes = e.viscous;
  const ResidualProducts of = creep_ ? account_creep(creep_->memory(), e) : products();
  if (!creep_)
    e.by_residual = settings_.stiffness_damping / dt * (of.end - 2.0 * of.across + of.start);
  const double by_table = account_residual(m, of, e);
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    const ConeContact& c = cones_[i];
    const Memory& was = memory_of(near.node);
    const contact::SpaceFrame& frame = touch_[i].frame;
    // The force before, as it stood in space.
    const Complex turned = conj(rotation(m.angle_next - m.angle)) * near.turn;
    const Vec3 before = frame.to(motion.attitude.to_fixed(turned * was.force));
    e.friction -= 0.5 * ((before.y + c.force.y) * c.moved.y + (before.z + c.force.z) * c.moved.z);
    if (was.known > 0 && was.gap[0] > 0.0) e.arrival += c.force.x * (was.gap[0] - c.moved.x);
  }
  report.turning_work =
      dt * dot(report.end.moment, motion.attitude_next.to_fixed(Vec3(motion.turning)));
  report.turning_inertia = m.kept_spin ? work_of_turning(motion) : 0.0;
  e.rim = dot(report.end.force, motion.center_next() - motion.center()) +
          (m.angle_next - m.angle) * report.torque + report.turning_work;
  report.lateral_work = report.end.force.z * (motion.lateral_next - motion.lateral);
  e.scheme += e.friction;
  e.scheme += e.arrival;
  e.scheme += e.rim;
  e.scheme += e.viscous - viscous_modes;
  e.scheme += by_table;
}

WheelEnergy SolidWheel::energy_at_start(bool softened) const {
  WheelEnergy e;
  const double by_spin = softened ? spin_ * spin_ : 0.0;
  e.residual = e.stored = residual_stored();
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const auto y = modes_[h].state.head(r);
    const double n = 0.5 * of.weight() * ring_.n_sectors();
    const double strain = n * y.cwiseAbs2().dot(of.squares);
    e.kinetic += n * modes_[h].state.tail(r).squaredNorm();
    e.stored += strain;
    e.elastic += strain - n * by_spin * y.dot(of.planar * y).real();
  }
  return e;
}

}  // namespace rondo::rom
