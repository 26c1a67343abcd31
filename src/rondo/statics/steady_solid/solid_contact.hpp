// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a steadily rolling wheel in three dimensions with flat ground
/// (docs/wheel3d.md), at a given height and speed or at a given load, traction or torque, slip
/// angle and camber, and how the forces change with each of these.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/statics/steady/rolling_contact.hpp"
#include "rondo/statics/steady_solid/solid_newton.hpp"
#include "rondo/statics/steady_solid/solid_window.hpp"

namespace rondo::statics {

struct SolidRollingSolution {
  RollingEnd end = RollingEnd::not_solved;
  double height = 0.0, speed = 0.0;     ///< [m], [m/s]
  double slip_angle = 0.0;              ///< [rad]
  Eigen::VectorXd force;                ///< (3 pairs) along n, t1, t2                         [N]
  Eigen::VectorXd gap_and_slip;         ///< (3 pairs) [m], [m/s]
  Eigen::VectorXd place;                ///< (2 pairs) along t1 and t2 from the center         [m]
  std::vector<contact::Status> status;  ///< (pairs)
  SolidRollingForces forces;
  int newton_steps = 0, sweeps = 0;
  double work = 0.0;      ///< of these, roughly, in floating-point operations
  double residual = 0.0;  ///< of the law, relative                                          [-]
  SolidRollingSlopes slopes;
};

/// The window grows by the pairs that are missing.
[[nodiscard]] SolidRollingSolution solve_rolling(SolidWindow& window,
                                                 const SolidRollingDrive& drive);

}  // namespace rondo::statics
