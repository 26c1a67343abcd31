// SPDX-License-Identifier: BSD-3-Clause
/// @file  V16: steady rolling of a disk of nearly incompressible rubber on rigid ground, compared
/// with Carter (K. L. Johnson, Contact Mechanics, 1985, 8.3): the traction is Q at a creep, by
/// which rotation exceeds travel, of (μ a/R)(1 - c/a) beyond that of free rolling; c/a = √(1 -
/// Q/(μP)) is the share of the contact that sticks, at the leading edge.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/models.hpp"
#include "support/stepping.hpp"

namespace rondo::test {

/// The disk moves to +x. It is slow compared with shear waves, 39 m/s, and so damped that the waves
/// of a node entering the contact decay within it; otherwise sliding chatters and Q stays below μP.
/// Inertia is (V/c)² = 0.3 %, drag ρ α V a/G = 0.2 %, stiffness damping β V/a = 0.01 % of the
/// elastic forces. The half plane requires small a/(μR) (curvature) and ν near ½.
struct CarterDisk {
  int radial = 10, columns = 450;
  double creep = 0.0;    ///< ω R/V - 1, ω the turning that rolls to +x [-]
  double grading = 2.0;  ///< of the layers, 1: equal

  static constexpr double radius = 0.3, depth = 1.0e-3, friction = 0.5, speed = 2.0;
  static constexpr double modulus = 5.0e6 / (1.0 - 0.49 * 0.49);
  static constexpr double lowered = 0.02;  ///< [s]
  static constexpr double settled = 0.12;  ///< 0.2 m after that, 6 contacts: e^-5 of the transient
  static constexpr double end = 0.14;      ///< [s] meanwhile 10 nodes of the coarsest mesh enter
};

/// Means over the last part of the run.
struct CarterMeans {
  double creep = 0.0;  ///< [-]
  Vec2 load;           ///< Q towards +x, P [N/m]
  // Moments of the unused friction μp - |q|: half an ellipse over the stick zone, zero elsewhere.
  double step = 0.0;     ///< [s]
  double stick = 0.0;    ///< twice its standard deviation along the ground: c [m]
  double ahead = 0.0;    ///< its center minus that of the pressure: a - c [m]
  double largest = 0.0;  ///< |q|/(μp) of all nodes in all states examined [-]

  [[nodiscard]] double half_width() const {
    return std::sqrt(4.0 * load.y * CarterDisk::radius / (std::numbers::pi * CarterDisk::modulus));
  }
  [[nodiscard]] double share() const { return load.x / (CarterDisk::friction * load.y); }
  /// μ a/R
  [[nodiscard]] double scale() const {
    return CarterDisk::friction * half_width() / CarterDisk::radius;
  }
};

/// c/a at a traction |Q|/(μP).
inline double carter_stick(double share) {
  return std::sqrt(std::max(0.0, 1.0 - std::abs(share)));
}
/// Creep over μ a/R at a traction Q/(μP), with its sign.
inline double carter_creep(double share) {
  return std::copysign(1.0 - carter_stick(share), share);
}

/// A node in contact at some time.
struct CarterSample {
  double x = 0.0;  ///< from the center, at the reference position as in V14 [m]
  Vec2 impulse;    ///< normal, tangential (towards -x) [N s/m]
};

inline CarterSample sample_of(const Built& b, const dynamics::State& state,
                              const dynamics::ActiveContact& contact) {
  const auto node = static_cast<std::size_t>(b.mesh.boundary[contact.candidate]);
  return {(state.frame.rotation * b.mesh.coordinates[node]).x, contact.impulse.plane()};
}

inline void add_spared_shear(const std::vector<CarterSample>& samples, CarterMeans& mean) {
  const double sense = std::copysign(1.0, -mean.load.x);
  double pressed = 0.0, center = 0.0, spared = 0.0, first = 0.0, second = 0.0;
  for (const CarterSample& s : samples) {
    const double limit = CarterDisk::friction * s.impulse.x, d = limit - sense * s.impulse.y;
    pressed += s.impulse.x;
    center += s.impulse.x * s.x;
    spared += d;
    first += d * s.x;
    second += d * s.x * s.x;
    mean.largest = std::max(mean.largest, std::abs(s.impulse.y) / limit);
  }
  mean.ahead = first / spared - center / pressed;
  mean.stick = 2.0 * std::sqrt(second / spared - std::pow(first / spared, 2));
}

inline CarterMeans roll(const CarterDisk& of) {
  using D = CarterDisk;
  DiskCase c;
  c.disk = {.outer_radius = D::radius,
            .inner_radius = 0.2,
            .radial = of.radial,
            .circumferential = of.columns,
            .grading = of.grading,
            .tread = {}};
  c.material = {5.0e6, 0.49, 1100.0, fem::Plane::strain, fem::Integration::b_bar};
  c.alpha = 100.0;
  c.beta = 1.0e-6;
  c.motion.angular_velocity = dynamics::Table((1.0 + of.creep) * D::speed / D::radius);
  c.motion.speed = dynamics::Table(D::speed);
  c.motion.height = dynamics::Table({{0.0, D::radius}, {D::lowered, D::radius - D::depth}});
  Built b = build(c);
  add_ground(b, {}, {D::friction, 0.0});
  Stepping run(b, dynamics::StiffnessOperator::cyclic);
  run.advance_to(D::settled);

  CarterMeans mean;
  mean.creep = of.creep;
  mean.step = b.model.dt;
  double steps = 0.0;
  std::vector<CarterSample> samples;
  while (run.report().frame.time < D::end) {
    run.advance(64, [&](const dynamics::StepReport& r) {
      mean.load += r.contact.impulse.plane() / b.model.dt;
      steps += 1.0;
    });
    for (const dynamics::ActiveContact& contact : run.state().active)
      if (contact.impulse.x > 0.0) samples.push_back(sample_of(b, run.state(), contact));
  }
  mean.load = mean.load / steps;
  add_spared_shear(samples, mean);
  EXPECT_LT(run.balance().relative, 1e-12);
  return mean;
}

/// Runs at a braking and a driving creep, and near free rolling, which is the reference of both.
/// @param creep allowed of (creep)/(μ a/R), zone of c/a and of the middle of the stick zone over a
inline void expect_carter(CarterDisk disk, std::array<double, 2> creeps, double creep,
                          double zone) {
  disk.creep = -0.0023;  // that of free rolling: strain of a pressed disk's edge, about (a/R)²
  const CarterMeans free = roll(disk);
  EXPECT_LT(std::abs(free.share()), 0.01);
  const double none = free.creep - free.scale() * carter_creep(free.share());
  for (const double given : creeps) {
    disk.creep = given;
    const CarterMeans m = roll(disk);
    const double a = m.half_width(), stick = carter_stick(m.share());
    EXPECT_GT(std::abs(m.share()), 0.5);
    EXPECT_NEAR((given - none) / m.scale(), carter_creep(m.share()), creep) << given;
    EXPECT_NEAR(m.stick / a, stick, zone) << given;
    EXPECT_NEAR(m.ahead / a, 1.0 - stick, zone) << given;
    EXPECT_LT(m.largest, 1.0 + 1e-12);
    testing::Test::RecordProperty(
        fmt::format("creep_{}_{}", disk.columns, given),
        fmt::format("Q/(muP) {:.4f}, creep {:.4f}, c/a {:.4f}, ahead {:.4f}", m.share(),
                    (given - none) / m.scale(), m.stick / a, m.ahead / a));
  }
}

}  // namespace rondo::test
