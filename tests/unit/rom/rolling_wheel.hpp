// SPDX-License-Identifier: BSD-3-Clause
/// @file  Runs of a reduced wheel with exact contact, for its tests.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "rondo/core/process_wide.hpp"
#include "rondo/rom/wheel/ring_wheel.hpp"
#include "rondo/rom/wheel/whole_mesh.hpp"
#include "support/models.hpp"

namespace rondo::rom::rolling_wheel {

constexpr double pi = std::numbers::pi;

/// The disk of cases/steady-rolling.toml, as a ring of its sectors or as a mesh without any.
struct Disk {
  rondo::test::Built built;
  fem::BlockCsr stiffness;  ///< empty: of sectors
  fem::SectorStiffness sector;
  std::vector<double> mass;

  Disk(int radial, int circumferential, bool whole_mesh = false) {
    built = rondo::test::build(rondo::test::rolling_disk(radial, circumferential));
    if (whole_mesh) stiffness = fem::assemble_stiffness(built.mesh, built.materials);
    sector = whole_mesh ? one_sector(whole()) : fem::assemble_sector(built.mesh, built.materials);
    mass = fem::move_contact_mass(built.mesh, built.model.mass, built.mesh.boundary).mass;
  }
  [[nodiscard]] bool is_whole() const { return sector.n_sectors == 1; }
  [[nodiscard]] WholeMesh whole() const { return {built.mesh, stiffness, built.model.free}; }
  [[nodiscard]] Ring ring() const {
    return make_ring(sector, mass, built.model.reference, built.mesh.boundary);
  }
};

inline const Disk& disk() {
  static const Disk d(12, 180);
  return d;
}

struct Rolling {
  int modes = 20;
  double passes = 2.618033989;  ///< steps in the pass of a sector
  contact::Friction friction = 0.4;
  ResidualForm form = ResidualForm::convected;
  SlipRule slip = SlipRule::anchored;
  double theta = 0.6;
  double spin = 100.0 / 3.0;  ///< ω, clockwise
  double speed = 10.0;
  double end = 0.2;
  double angle = 0.0;  ///< θ at the start
  std::optional<dynamics::Table> spins{};
  double lowest = 0.29;
  bool damped = true;
  contact::GroundShape ground{};
  double start_x = 0.0;
  std::vector<fem::ViscousBranch> branches{};
  double stiffness_damping = 2e-5;  ///< of what is damped
  std::vector<double> lengths{};    ///< as WheelSettings has them

  [[nodiscard]] WheelSettings settings(double dt) const {
    return {{dt, damped ? 200.0 : 0.0, damped ? stiffness_damping : 0.0, theta},
            friction,
            slip,
            lengths};
  }
};

struct Outcome {
  double x = 0.0, y = 0.0, deviation = 0.0;  ///< means of the last quarter, deviation of F_y
  double unbalanced = 0.0;                   ///< largest defect of the ledger in a step [J/m]
  double energy = 0.0;                       ///< largest [J/m]
  double residual = 0.0;                     ///< of the law
  WheelEnergy sums{};
  double least_viscous = 0.0;  ///< loss of the branches in a step [J/m]
  double unsplit = 0.0;        ///< most by which work of the inner forces is not stored or lost
  std::vector<Vec2> forces;
};

inline double total(const WheelEnergy& e) {
  return e.kinetic + e.elastic + e.residual;
}
inline double change(const WheelEnergy& e) {
  return e.frame - e.by_mass - e.by_stiffness - e.by_residual - e.viscous - e.friction - e.arrival -
         e.rim + e.scheme;
}

/// The motion of a run: lowered from 0.31 m in 0.02 s.
class Motion {
 public:
  Motion(const Rolling& run, double dt)
      : run_(run), dt_(dt), height_({{0.0, 0.31}, {0.02, run.lowest}}) {
    if (run.spins)
      spin_ = *run.spins;
    else
      spin_ = dynamics::Table(run.spin);
  }
  [[nodiscard]] WheelMotion at(int n) const {
    const double t = n * dt_, end = (n + 1) * dt_;
    WheelMotion m;
    m.angle = run_.angle - spin_.integral(0.0, t);
    m.angle_next = m.angle - spin_.integral(t, dt_);
    m.spin_next = -spin_.at(end);
    m.spin_rate = -spin_.change(t, dt_) / dt_;
    m.center = {run_.start_x + run_.speed * t, height_.at(t)};
    m.center_next = {run_.start_x + run_.speed * end, height_.at(end)};
    const double before = n > 0 ? height_.change(t - dt_, dt_) / dt_ : height_.slope(0.0);
    m.pull = {0.0, (height_.change(t, dt_) / dt_ - before) / dt_};
    return m;
  }
  [[nodiscard]] WheelMotion start() const {
    WheelMotion m = at(0);
    m.angle_next = m.angle;
    m.center_next = m.center;
    m.spin_next = -spin_.at(0.0);
    m.spin_rate = 0.0;
    return m;
  }

 private:
  Rolling run_;
  double dt_;
  dynamics::Table height_, spin_;
};

inline WheelModel model_of(const Disk& d, const Ring& ring, const Rolling& run) {
  WheelModel model;
  model.harmonics = d.is_whole() ? whole_modes(ring, d.whole(), {.wanted = run.modes})
                                 : ring_modes(ring, {.wanted = run.modes});
  model.squares = {run.spin * run.spin};
  if (run.spins) {
    const double most = std::pow(run.spins->largest(), 2);
    model.squares = {0.067 * most, 0.5 * most, 0.933 * most};
  }
  model.radius = 0.3;
  if (!run.branches.empty()) {
    model.branches = run.branches;
    model.creep = creep_terms(run.branches, run.settings(1.0).stiffness_damping);
    for (const double square : model.squares) {
      CreepResidual both;
      if (d.is_whole())
        both.at_once = both.later = whole_residual(ring, d.whole(), model.harmonics, square);
      else
        both = creep_residual(ring, model.harmonics, square, model.creep);
      model.residuals.push_back(both.at_once);
      model.later.push_back(both.later);
    }
    return model;
  }
  for (const double square : model.squares)
    model.residuals.push_back(d.is_whole()
                                  ? whole_residual(ring, d.whole(), model.harmonics, square)
                                  : ring_residual(ring, model.harmonics, square, run.form));
  return model;
}

struct Wheel {
  const Disk& of;
  Ring ring;
  contact::Ground ground;
  double dt;
  WheelModel model;
  RingWheel wheel;
  Motion motion;

  Wheel(const Disk& d, const Rolling& run)
      : of(d),
        ring(d.ring()),
        ground(run.ground),
        dt(2.0 * pi / static_cast<double>(d.built.mesh.boundary.size()) /
           std::abs(run.spin == 0.0 ? 100.0 / 3.0 : run.spin) / run.passes),
        model(model_of(d, ring, run)),
        wheel(ring, model, ground, run.settings(dt)),
        motion(run, dt) {
    wheel.start(motion.start());
  }
};

inline Outcome outcome(const Rolling& run, const Disk& d = disk()) {
  const OneBlasThread one;
  Wheel w(d, run);
  Outcome o;
  const auto n = static_cast<int>(std::lround(run.end / w.dt));
  double energy = 0.0, squares = 0.0, stored = w.wheel.energy_at_start(true).stored;
  int counted = 0;
  for (int i = 0; i < n; ++i) {
    const WheelReport r = w.wheel.step(w.motion.at(i));
    const double now = total(r.energy);
    if (i > 0) o.unbalanced = std::max(o.unbalanced, std::abs(now - energy - change(r.energy)));
    o.energy = std::max(o.energy, std::abs(now));
    o.residual = std::max(o.residual, r.law_residual);
    o.unsplit = std::max(
        o.unsplit, std::abs(r.energy.internal - (r.energy.stored - stored) - r.energy.viscous));
    stored = r.energy.stored;
    o.sums.viscous += r.energy.viscous;
    o.least_viscous = std::min(o.least_viscous, r.energy.viscous);
    o.sums.by_mass += r.energy.by_mass;
    o.sums.by_stiffness += r.energy.by_stiffness;
    o.sums.by_residual += r.energy.by_residual;
    o.sums.friction += r.energy.friction;
    o.sums.arrival += r.energy.arrival;
    energy = now;
    o.forces.push_back(r.force);
    if ((i + 1) * w.dt <= 0.75 * run.end) continue;
    ++counted;
    o.x += r.force.x;
    o.y += r.force.y;
    squares += r.force.y * r.force.y;
  }
  o.x /= counted;
  o.y /= counted;
  o.deviation = std::sqrt(std::max(0.0, squares / counted - o.y * o.y));
  return o;
}

}  // namespace rondo::rom::rolling_wheel
