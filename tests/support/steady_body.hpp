// SPDX-License-Identifier: BSD-3-Clause
/// @file  Bodies whose steady rolling is solved by tests.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "rondo/statics/steady/rolling_power.hpp"
#include "support/models.hpp"

namespace rondo::test {

/// A disk with its harmonics, for spin and damping of the case.
struct SteadyBody {
  /// @param turned angle of the mesh relative to its samples [rad]
  SteadyBody(const DiskCase& c, int samples, bool massless, double turned = 0.0) {
    mesh = mesh::make_disk(c.disk);
    for (Vec2& x : mesh.coordinates) x = rotation(turned) * x;
    mass = fem::lumped_mass(mesh, {&c.material, 1});
    sector = fem::assemble_sector(mesh, {&c.material, 1});
    harmonics = std::make_unique<statics::RollingHarmonics<2>>(
        statics::RollingBody<2>{.stiffness = sector,
                                .mass = mass,
                                .reference = mesh.coordinates,
                                .candidates = candidates(),
                                .spin = -c.motion.angular_velocity.at(0.0),
                                .mass_damping = c.alpha,
                                .stiffness_damping = c.beta,
                                .samples = samples,
                                .massless = massless});
    gravity = c.motion.gravity.at(0.0);
  }
  SteadyBody(const SteadyBody&) = delete;
  SteadyBody& operator=(const SteadyBody&) = delete;

  [[nodiscard]] statics::RollingWindow<2> window(statics::SlipDifference slip) const {
    return {*harmonics, slip, 0.0, gravity};
  }

  mesh::Mesh mesh;
  std::vector<double> mass;
  fem::SectorStiffness sector;
  std::unique_ptr<statics::RollingHarmonics<2>> harmonics;
  double gravity = 0.0;  ///< downwards [m/s²]

 private:
  /// Rows of the sector that belong to nodes that may touch.
  [[nodiscard]] std::vector<int> candidates() const {
    std::vector<char> touches(mesh.n_nodes(), 0);
    for (const int node : mesh.boundary) touches[static_cast<std::size_t>(node)] = 1;
    std::vector<int> rows;
    for (std::size_t a = 0; a < sector.n_local(); ++a)
      if (touches[sector.node(a, 0)] != 0) rows.push_back(static_cast<int>(a));
    return rows;
  }
};

/// Bounds of a solution. Round-off of a gap over the deformation of one pair, and that of powers
/// over what remains of them, grows with the number of pairs.
struct SteadyBounds {
  double law = 1e-10, power = 1e-12;
};
constexpr SteadyBounds finest_bounds{1e-9, 1e-11};  ///< for 7,000 columns and more

/// The solution; expects that it satisfies the law and that its power is balanced.
inline statics::RollingSolution solved(statics::RollingWindow<2>& window,
                                       const statics::RollingDrive& drive,
                                       SteadyBounds bounds = {}) {
  statics::RollingSolution s = solve_rolling(window, drive);
  EXPECT_EQ(s.end, statics::RollingEnd::solved);
  EXPECT_LT(rolling_residual(window, s, drive.friction), bounds.law);
  EXPECT_LT(rolling_power(window, s, spectrum_of(window, s)).residual, bounds.power);
  return s;
}

/// The disk of V18: V = 10 m/s, 0.29 m above the ground.
inline statics::RollingDrive at_height(double friction) {
  return {.height = 0.29,
          .speed = 10.0,
          .friction = friction,
          .load = {},
          .traction = {},
          .torque = {}};
}

}  // namespace rondo::test
