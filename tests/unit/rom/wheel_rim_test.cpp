// SPDX-License-Identifier: BSD-3-Clause
/// Reduced wheels on rims that move: momentum, energy, supports and the brake.
#include "rondo/rom/wheel/wheel_rim.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rondo/rom/make_wheel_model.hpp"
#include "rondo/rom/wheel_run.hpp"
#include "support/models.hpp"

namespace rondo::rom {
namespace wheel_rim_test {
namespace {

using dynamics::Table;

dynamics::RimBody all_free() {
  dynamics::RimBody rim;
  rim.free_x = rim.free_y = rim.free_spin = true;
  rim.mass = 60.0;
  rim.inertia = 1.0;
  return rim;
}

/// A small disk over flat ground, on a rim.
struct OnRim {
  rondo::test::Built built;
  fem::SectorStiffness sector;
  std::vector<double> mass;
  std::optional<Ring> ring;
  WheelModel wheel;

  OnRim(rondo::test::DiskCase c, const dynamics::RimBody& rim,
        const std::vector<fem::ViscousBranch>& branches = {}) {
    built = rondo::test::build(c);
    rondo::test::set_rim(built, rim);
    rondo::test::add_ground(built, {}, {0.4, 0.0});
    sector = fem::assemble_sector(built.mesh, built.materials);
    mass = fem::move_contact_mass(built.mesh, built.model.mass, built.mesh.boundary).mass;
    built.model.lumped_mass = built.model.mass;
    built.model.mass = mass;
    built.model.dt = 2e-4;
    ring.emplace(make_ring(sector, mass, built.model.reference, built.mesh.boundary));
    wheel = make_wheel_model(*ring, ring_modes(*ring, {.wanted = 20}), {33.0, 66.0, true}, nullptr,
                             {branches, built.model.stiffness_damping});
  }
  [[nodiscard]] WheelSettings settings() const {
    const dynamics::Model& m = built.model;
    return {{.dt = m.dt, .mass_damping = m.mass_damping, .stiffness_damping = m.stiffness_damping},
            0.4};
  }
};

/// Ring and rim, step by step.
class Steps {
 public:
  explicit Steps(const OnRim& on)
      : model_(on.built.model),
        wheel_(*on.ring, on.wheel, model_.contact->ground, on.settings()),
        rim_(model_, on.settings().theta, on.wheel.largest_spin) {
    wheel_.start(rim_.at_start());
    rim_.start(wheel_.sums(), wheel_.force_at_start());
  }
  /// Makes a step and finds the energy of all after it.
  WheelReport step() {
    works_ = {};
    const WheelReport report = wheel_.step(n_++, rim_, works_);
    energy_ = {};
    energy_.kinetic = report.energy.kinetic;
    energy_.strain = report.energy.elastic + report.energy.residual;
    rim_.add_energy(energy_);
    return report;
  }
  [[nodiscard]] RimVector momentum() const {
    const Vec2 v = rim_.report().velocity;
    const double s = -rim_.report().spin;
    return RimVector(rim_.whole_mass() * v.x, rim_.whole_mass() * v.y, rim_.whole_inertia() * s) +
           wheel_.sums().of(s);
  }
  [[nodiscard]] double energy() const {
    return energy_.kinetic + energy_.strain + energy_.kinetic_rim + energy_.support;
  }
  /// Works that the rim has added in the last step.
  [[nodiscard]] const dynamics::Works& works() const { return works_; }
  [[nodiscard]] const WheelRim& rim() const { return rim_; }

 private:
  const dynamics::Model& model_;
  RingWheel wheel_;
  WheelRim rim_;
  int n_ = 0;
  dynamics::Works works_;
  dynamics::StepEnergy energy_;
};

rondo::test::DiskCase flying() {
  rondo::test::DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.height = Table(0.6);
  c.motion.speed = Table(3.0);
  return c;
}

/// Also of the deformation, which a torque and the weight shake.
TEST(WheelRim, KeepsItsMomentumInFlight) {
  rondo::test::DiskCase c = flying();
  c.motion.gravity = Table(9.81);
  c.motion.slope = 0.2;
  dynamics::RimBody rim = all_free();
  rim.torque = Table({{0.0, 0.0}, {0.004, 2e4}, {0.008, 0.0}});
  const OnRim on(c, rim);
  Steps steps(on);
  steps.step();
  const RimVector at_first = steps.momentum();
  const double scale = at_first.head<2>().norm();
  double torque = 0.0, shaken = 0.0;
  for (int k = 1; k < 200; ++k) {
    const double t = k * on.built.model.dt;
    torque -= rim.torque.integral(t, on.built.model.dt);
    steps.step();
    const Vec2 g = c.motion.gravity_at(0.0);
    const double time = k * on.built.model.dt, weight = steps.rim().whole_mass() * time;
    const RimVector now = steps.momentum();
    // What products of unknowns leave in a step is given back in the next.
    EXPECT_NEAR(now[0], at_first[0] + weight * g.x, 1e-8 * scale);
    EXPECT_NEAR(now[1], at_first[1] + weight * g.y, 1e-8 * scale);
    EXPECT_NEAR(now[2], at_first[2] + torque, 1e-6 * std::abs(at_first[2]));
    shaken = std::max(shaken,
                      std::abs(now[2] - steps.rim().whole_inertia() * -steps.rim().report().spin));
  }
  EXPECT_GT(shaken, 1e-5 * std::abs(at_first[2]));
}

dynamics::RimBody loaded() {
  dynamics::RimBody rim = all_free();
  rim.force_y = Table({{0.0, 0.0}, {0.005, -1.5e5}});
  rim.force_x = Table({{0.0, 2e4}, {0.01, -1e4}});
  rim.torque = Table({{0.0, 0.0}, {0.01, 2e4}});
  rim.brake = Table({{0.0, 0.0}, {0.01, 5e3}});
  rim.support_x = {2e4, 1e3, 0.1};
  rim.support_y = {1e5, 4e4, 0.31};
  return rim;
}

/// Nothing else acts on what is held. @param k x, y, spin; other: none
void hold(int k, dynamics::RimBody& rim) {
  if (k == 0) {
    rim.free_x = false;
    rim.force_x = Table(0.0);
    rim.support_x = {};
  } else if (k == 1) {
    rim.free_y = false;
    rim.force_y = Table(0.0);
    rim.support_y = {};
  } else if (k == 2) {
    rim.free_spin = false;
    rim.torque = rim.brake = Table(0.0);
  }
}

rondo::test::DiskCase pressed() {
  rondo::test::DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.height = Table(0.3);
  c.motion.gravity = Table(9.81);
  c.motion.slope = 0.1;
  return c;
}

/// With all that a rim may have, and each component held in turn.
TEST(WheelRim, EnergyIsWhatWorksMakeIt) {
  for (int way = 0; way < 8; ++way) {
    const int held = way % 4;
    const bool viscous = way >= 4;
    dynamics::RimBody rim = loaded();
    hold(held - 1, rim);
    rondo::test::DiskCase c = pressed();
    if (held == 1) c.motion.speed = Table({{0.0, 10.0}, {0.02, 11.0}});
    if (held == 2) c.motion.height = Table({{0.0, 0.3}, {0.01, 0.294}});
    if (held == 3) c.motion.angular_velocity = Table({{0.0, 33.0}, {0.02, 36.0}});
    std::vector<fem::ViscousBranch> branches;
    if (viscous) branches = {{0.2, 1e-3}, {0.1, 1e-2}};
    const OnRim on(c, rim, branches);
    Steps steps(on);
    steps.step();
    double before = steps.energy(), pressing = 0.0, lost = 0.0;
    for (int k = 1; k < 150; ++k) {
      const WheelReport r = steps.step();
      const dynamics::Works& w = steps.works();
      const WheelEnergy& e = r.energy;
      const double made = w.gravity + w.rim_load + w.torque + w.held - w.dissipation_brake -
                          w.dissipation_support + w.scheme + e.scheme - e.by_mass - e.by_stiffness -
                          e.by_residual - e.viscous - e.friction - e.arrival;
      EXPECT_NEAR(steps.energy() - before, made, 1e-10 * steps.energy()) << way << " " << k;
      EXPECT_GE(e.viscous, 0.0);
      lost += e.viscous;
      before = steps.energy();
      pressing = std::max(pressing, r.force.y);
    }
    EXPECT_GT(pressing, 5e4) << way;
    EXPECT_EQ(lost > 1.0, viscous) << lost;
  }
}

/// Momentum is the impulse of ground, loads, supports and of what holds a component.
TEST(WheelRim, ForcesAreTheChangeOfMomentum) {
  dynamics::RimBody rim = loaded();
  hold(0, rim);
  const OnRim on(pressed(), rim);
  Steps steps(on);
  Vec2 last = steps.step().force;
  const double dt = on.built.model.dt, theta = on.settings().theta;
  const RimVector at_first = steps.momentum();
  Vec2 impulse = {}, center = steps.rim().frame().center.plane();
  for (int k = 1; k < 120; ++k) {
    const double t = k * dt;
    const Vec2 rate_before = steps.rim().report().velocity;
    const WheelReport r = steps.step();
    const Vec2 middle = 0.5 * (center + steps.rim().frame().center.plane());
    const Vec2 rate = 0.5 * (rate_before + steps.rim().report().velocity);
    const Vec2 g = on.built.model.motion.gravity_at(t);
    const Vec2 ground = theta * r.force + (1.0 - theta) * last;
    const Vec2 held = steps.rim().report().force;
    impulse += dt * (ground + steps.rim().whole_mass() * g + held);
    impulse.y += rim.force_y.integral(t, dt) - dt * (1e5 * (middle.y - 0.31) + 4e4 * rate.y);
    const RimVector now = steps.momentum();
    EXPECT_NEAR(now[1] - at_first[1], impulse.y, 1e-5 * 1.5e5 * dt) << k;
    EXPECT_NEAR(now[0] - at_first[0], impulse.x, 1e-5 * 1.5e5 * dt) << k;
    last = r.force;
    center = steps.rim().frame().center.plane();
  }
  EXPECT_GT(last.y, 5e4);
}

/// It comes to rest, and stays to the bit while the brake is stronger than the torque.
TEST(WheelRim, ABrakeHoldsUntilTheTorqueIsStronger) {
  dynamics::RimBody rim = all_free();
  rim.brake = Table(2e5);
  rim.torque = Table({{0.0, 0.0}, {0.01, 0.0}, {0.02, 4e5}});
  const OnRim on(flying(), rim);
  Steps steps(on);
  bool rested = false;
  for (int k = 0; k < 150; ++k) {
    const double t = k * on.built.model.dt;
    steps.step();
    const double spin = steps.rim().report().spin;
    EXPECT_GE(spin, 0.0) << t;
    if (spin == 0.0) rested = true;
    if (rested && t < 0.0145) {
      EXPECT_EQ(spin, 0.0) << t;
    }
  }
  EXPECT_TRUE(rested);
  EXPECT_GT(steps.rim().report().spin, 1.0);
  EXPECT_FALSE(steps.rim().gave_up());
}

}  // namespace
}  // namespace wheel_rim_test
}  // namespace rondo::rom
