// SPDX-License-Identifier: BSD-3-Clause
/// @file  Internal forces of the body for the general step: forces of its deformation, their
/// energy, and stiffness-proportional damping. Each material or kinematics is a class of its own,
/// and the step does not depend on any of them.
#pragma once
#include <memory>
#include <span>

#include "rondo/model/material_report.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::dynamics {

/// Fields are of all nodes (n), in the frame in which a node moves; those of clamped nodes are not
/// read and have no meaning.
class InternalForce {
 public:
  virtual ~InternalForce() = default;
  InternalForce() = default;
  InternalForce(const InternalForce&) = delete;
  InternalForce& operator=(const InternalForce&) = delete;

  /// Moves on to displacements u; the previous result is kept for the half step.
  virtual void evaluate(std::span<const Vec2> u) noexcept = 0;
  /// Derivative of the energy with respect to the nodes' positions: minus the force    [N/m]
  [[nodiscard]] virtual std::span<const Vec2> gradient() const noexcept = 0;
  /// Strain energy of (5.1), half a step before u, with the velocity v of that half step [J/m]
  [[nodiscard]] virtual double half_step_energy(std::span<const Vec2> u,
                                                std::span<const Vec2> v) const noexcept = 0;
  /// β times the rate of the gradient over the step that ended at the last u           [N/m]
  virtual void damping(std::span<Vec2> out) noexcept = 0;
  /// (free_bodies) Poses at the last u.
  [[nodiscard]] virtual std::span<const Pose> poses() const noexcept { return {}; }

  /// Energies of rubber at the last u.
  [[nodiscard]] virtual MaterialReport material() const noexcept { return {}; }

  /// Saves what it carries to the next step: force, gradient, energy, poses, and for rubber its
  /// branches and works.
  virtual void save(SavedState& saved) const = 0;
  virtual void restore(const SavedState& saved) = 0;
};

/// The internal force of the model at displacements u_0: that of its own material
/// (Model::internal_force), else that of the stiffness. The model must outlive it.
/// @param poses (free_bodies) from which whole turns are counted. @pre the assembled stiffness
[[nodiscard]] std::unique_ptr<InternalForce> make_internal_force(const Model& model,
                                                                 std::span<const Vec2> u0,
                                                                 std::span<const Pose> poses);

}  // namespace rondo::dynamics
