// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rim as a rigid body with its supports, loads and brake (docs/theory.md,
/// section 10).
#pragma once
#include "rondo/model/motion.hpp"

namespace rondo::dynamics {

/// A spring and a dashpot between the center and a fixed point, along x or y.
struct RimSupport {
  double stiffness = 0.0;  ///< k >= 0                                                [N/m²]
  double damping = 0.0;    ///< k_d >= 0                                              [N·s/m²]
  double at = 0.0;         ///< position of the unloaded spring, fixed frame             [m]
};

/// Each degree of freedom of the center and of the spin is free or prescribed by the tables of the
/// motion. For a free one, the tables give the value at t = 0.
struct RimBody {
  bool free_x = false, free_y = false, free_spin = false;
  /// M; in a Model it includes the clamped nodes, in a Case it does not                [kg/m]
  double mass = 0.0;
  double inertia = 0.0;    ///< I, about the center, with or without them as M             [kg·m]
  Table force_x, force_y;  ///< on the center, fixed frame                              [N/m]
  Table torque;            ///< > 0 drives towards +x: clockwise                        [N]
  Table brake;             ///< >= 0, Coulomb-like: it never reverses the spin           [N]
  RimSupport support_x, support_y;
};

}  // namespace rondo::dynamics
