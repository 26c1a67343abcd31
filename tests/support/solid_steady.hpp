// SPDX-License-Identifier: BSD-3-Clause
/// @file  Wheels that roll steadily in three dimensions, used by several tests.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "rondo/statics/steady/rolling_power.hpp"
#include "support/solid_wheel.hpp"

namespace rondo::test {

struct SteadyWheelCase {
  mesh::Wheel wheel;
  double grading = 1.0;  ///< of the section across, finer in the middle: exponent of z/z_max
  fem::Material material;
  double spin = 0.0;  ///< s = -ω; 0: it stands, without inertia [rad/s]
  double mass_damping = 0.0, stiffness_damping = 0.0;
  double reach = 1.0;  ///< largest distance of candidates from the middle [m]
  int samples = 1;
  bool massless = false;
  int threads = 1;
};

/// The section of a crowned wheel with graded lines across the width.
inline mesh::Mesh graded_section(const SteadyWheelCase& c) {
  mesh::Mesh section = mesh::make_section(c.wheel);
  if (c.grading == 1.0) return section;
  const double half = 0.5 * c.wheel.width, crown = *c.wheel.crown_radius;
  const std::vector<double> radii = mesh::layer_radii(c.wheel.disk);
  const auto across = static_cast<std::size_t>(c.wheel.axial) + 1;
  for (std::size_t i = 0; i < section.n_nodes(); ++i) {
    const double part = section.coordinates[i].y / half, r = radii[i / across];
    const double z = half * std::copysign(std::pow(std::abs(part), c.grading), part);
    const double drop = z * z / (crown + std::sqrt(crown * crown - z * z));
    section.coordinates[i] = {r - drop * (r - radii.front()) / (radii.back() - radii.front()), z};
  }
  return section;
}

/// The harmonics of the wheel, which depend on the other members.
class SteadyWheel {
 public:
  explicit SteadyWheel(const SteadyWheelCase& c)
      : mesh(made(c)),
        mass(fem::solid_mass(mesh, std::vector{c.material})),
        sector(fem::assemble_solid_sector(mesh, std::vector{c.material})),
        harmonics({.stiffness = sector,
                   .mass = mass,
                   .reference = mesh.coordinates,
                   .axial = mesh.axial,
                   .candidates = candidates(c.reach),
                   .spin = c.spin,
                   .mass_damping = c.mass_damping,
                   .stiffness_damping = c.stiffness_damping,
                   .samples = c.samples,
                   .massless = c.massless,
                   .inertia =
                       c.spin == 0.0 ? statics::RollingInertia::none : statics::RollingInertia::all,
                   .threads = c.threads}) {}
  SteadyWheel(const SteadyWheel&) = delete;
  SteadyWheel& operator=(const SteadyWheel&) = delete;

  mesh::Mesh mesh;
  std::vector<double> mass;
  fem::SolidSector sector;
  statics::RollingHarmonics<3> harmonics;

  /// Area of each candidate of the harmonics [m²].
  [[nodiscard]] std::vector<double> areas() const {
    std::vector<double> of_node(mesh.n_nodes()), areas;
    for (std::size_t k = 0; k < mesh.boundary.size(); ++k)
      of_node[static_cast<std::size_t>(mesh.boundary[k])] = mesh.tributary[k];
    for (const int row : harmonics.body().candidates)
      areas.push_back(of_node[sector.node(static_cast<std::size_t>(row), 0)]);
    return areas;
  }

 private:
  static mesh::Mesh made(const SteadyWheelCase& c) {
    const mesh::Mesh section = graded_section(c);
    return mesh::revolve(section, mesh::columns_of(c.wheel, section), "tread");
  }
  [[nodiscard]] std::vector<int> candidates(double reach) const {
    std::vector<char> touches(mesh.n_nodes());
    for (const int node : mesh.boundary) touches[static_cast<std::size_t>(node)] = 1;
    std::vector<int> rows;
    for (std::size_t a = 0; a < sector.n_local(); ++a) {
      const std::size_t node = sector.node(a, 0);
      if (touches[node] && std::abs(mesh.axial[node]) < reach) rows.push_back(static_cast<int>(a));
    }
    return rows;
  }
};

/// The wheel of docs/wheel3d.md at 33.76455 rad/s.
inline SteadyWheelCase box_wheel_case(int samples = 4) {
  SteadyWheelCase c;
  c.wheel = box_wheel();
  c.material = box_rubber();
  c.spin = -33.76455;
  c.mass_damping = 200.0;
  c.stiffness_damping = 2e-5;
  c.samples = samples;
  c.massless = samples > 1;
  return c;
}

/// Two layers of three elements and 36 columns of it.
inline SteadyWheelCase small_case(int samples = 2) {
  SteadyWheelCase c = box_wheel_case(samples);
  c.wheel = box_wheel(2, 3, 36);
  return c;
}

/// A window of the wheel that leans by .05 rad. @param gravity [m/s²]
inline statics::RollingWindow<3> cambered(const SteadyWheel& w, double gravity = 0.0) {
  return {w.harmonics, statics::SlipDifference::bdf2, 0.05, gravity};
}

inline void expect_near(const statics::RollingForces& a, const statics::RollingForces& b,
                        double bound) {
  EXPECT_NEAR(a.normal, b.normal, bound);
  EXPECT_NEAR(a.heading, b.heading, bound);
  EXPECT_NEAR(a.lateral, b.lateral, bound);
  EXPECT_NEAR(a.torque, b.torque, bound);
  EXPECT_NEAR(a.aligning, b.aligning, bound);
  EXPECT_NEAR(a.overturning, b.overturning, bound);
}

inline statics::RollingForces difference(const statics::RollingForces& a,
                                         const statics::RollingForces& b, double by) {
  return {(a.normal - b.normal) / by,     (a.heading - b.heading) / by,
          (a.lateral - b.lateral) / by,   (a.torque - b.torque) / by,
          (a.aligning - b.aligning) / by, (a.overturning - b.overturning) / by};
}

/// A wheel of radius .3 m at 10 m/s, .29 m high, at a slip angle.
inline statics::RollingDrive cornering_drive() {
  statics::RollingDrive d;
  d.height = 0.29;
  d.speed = 10.0;
  d.slip_angle = 0.03;
  d.friction = 0.4;
  return d;
}

/// Radius .3 m, rolling slowly, with contacts that are small compared with it.
inline SteadyWheelCase crowned_case(double crown, int radial, int axial, int around,
                                    double grading) {
  SteadyWheelCase c;
  c.wheel.disk = {.outer_radius = 0.3,
                  .inner_radius = 0.1,
                  .radial = radial,
                  .circumferential = around,
                  .grading = 2.0,
                  .tread = {}};
  c.wheel.width = 0.18;
  c.wheel.axial = axial;
  c.wheel.crown_radius = crown;
  c.grading = grading;
  c.material.youngs_modulus = 5e6;
  c.material.poissons_ratio = 0.45;
  c.material.density = 1000.0;
  c.material.integration = fem::Integration::b_bar;
  c.spin = -1e-3;
  c.reach = 0.06;
  return c;
}

/// The solution; expects that its power is balanced.
inline statics::RollingSolution solved(statics::RollingWindow<3>& window,
                                       const statics::RollingDrive& drive) {
  const statics::RollingSolution s = statics::solve_rolling(window, drive);
  EXPECT_EQ(s.end, statics::RollingEnd::solved) << s.residual;
  EXPECT_LE(s.residual, 1e-10);
  EXPECT_LE(rolling_power(window, s, spectrum_of(window, s)).residual, 1e-10);
  return s;
}

}  // namespace rondo::test
