// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of one step: which candidates touch, what velocity the law sees, the impulses,
/// and the velocities corrected by them (docs/theory.md, section 4).
#pragma once
#include "rondo/dynamics/model.hpp"

namespace rondo::dynamics {

/// What the contact phase of a step found. Sums are over the active contacts.
struct ContactReport {
  Vec2 impulse;                  ///< of the ground on the body, fixed frame             [N·s/m]
  double angular_impulse = 0.0;  ///< about the centre                                [N·s]
  int nodes = 0;                 ///< candidates with r_n > 0
  int sticking = 0;              ///< of these, those that stick
  int pairs = 0;                 ///< nodes held by two facets
  int pairs_not_converged = 0;   ///< of these, no case met the law to 1e-12
  double length = 0.0;           ///< Σ tributary lengths of nodes with r_n > 0           [m]
  double penetration = 0.0;      ///< largest -gap of an active contact, >= 0             [m]
  double free_velocity = 0.0;    ///< largest |w_free|                                    [m/s]
  double residual = 0.0;         ///< largest law residual over the node's mass           [m/s]
};

/// Finds the active contacts of state.u, solves them, and corrects state.v_next, which holds the
/// contact-free velocities, by the impulses. Fills state.active. Allocates nothing.
[[nodiscard]] ContactReport contact_phase(const Model& model, State& state,
                                          const VelocityUpdate& update) noexcept;

}  // namespace rondo::dynamics
