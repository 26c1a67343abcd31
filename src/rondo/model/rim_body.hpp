// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rim that is a rigid body of its own: what holds, loads and brakes it (docs/theory.md,
/// section 10).
#pragma once
#include "rondo/model/motion.hpp"

namespace rondo::dynamics {

/// A spring and a dashpot between the center and a fixed place, along x or y.
struct RimSupport {
  double stiffness = 0.0;  ///< k >= 0                                                [N/m²]
  double damping = 0.0;    ///< k_d >= 0                                              [N·s/m²]
  double at = 0.0;         ///< where the spring is at rest, fixed frame              [m]
};

/// Each degree of freedom of the center and of the spin is free, or held by the tables of the
/// motion; of a free one these give the value at t = 0.
struct RimBody {
  bool free_x = false, free_y = false, free_spin = false;
  /// M, that of the clamped nodes included in a Model, and not in a Case               [kg/m]
  double mass = 0.0;
  double inertia = 0.0;    ///< I, about the center, likewise                             [kg·m]
  Table force_x, force_y;  ///< on the center, fixed frame                              [N/m]
  Table torque;            ///< > 0 drives towards +x: clockwise                        [N]
  Table brake;             ///< >= 0, of Coulomb's kind: it never reverses the spin     [N]
  RimSupport support_x, support_y;
};

}  // namespace rondo::dynamics
