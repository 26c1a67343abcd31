// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a reduced wheel reports of a step, in the plane and in three dimensions.
#pragma once

namespace rondo::rom {

/// Energies at the end of a step, and the works in it [J/m], in space [J].
struct WheelEnergy {
  double kinetic = 0.0;   ///< of the modes, in the co-rotating frame
  double elastic = 0.0;   ///< of the modes; on tables less what the spin softens them by
  double residual = 0.0;  ///< of the compliance of the contact nodes
  double stored = 0.0;    ///< elastic and residual, without the softening
  double frame = 0.0;     ///< work of the inertia of the frame and of gravity
  double by_mass = 0.0, by_stiffness = 0.0;  ///< taken by damping of the modes
  double by_residual = 0.0;                  ///< taken by damping of the residual
  double viscous = 0.0;   ///< taken by the viscous branches of the material, >= 0
  double internal = 0.0;  ///< work against all elastic and viscous forces, found from these forces
  double friction = 0.0;  ///< taken by friction
  double arrival = 0.0;   ///< taken where nodes arrive, as distance from the ground
  double rim = 0.0;       ///< work of the ground's forces on the rim
  double scheme = 0.0;    ///< by which the distances of the law differ from the work of the forces
};

/// What the reports of both have. Forces are per metre of width in the plane.
struct WheelOutcome {
  /// Torque of the ground's forces about the axle, counter-clockwise, at the end of the step; and
  /// its mean, θ times this and 1 - θ times that at the start [N], [N m]
  double torque = 0.0, mean_torque = 0.0;
  WheelEnergy energy;
  int candidates = 0;          ///< nodes whose contact was solved
  int iterations = 0;          ///< of the law
  bool second_method = false;  ///< solved it: pivoting in the plane, in space Newton's method
  bool late = false;  ///< μ is that by the step before: that by the step itself was not found
  double law_residual = 0.0;  ///< over the largest force
  double free = 0.0;  ///< largest distance that a contact would move without forces      [m]
};

}  // namespace rondo::rom
