// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the body does to its own nodes, for the general step: forces of its deformation,
/// their energy, and the damping that goes with them. A material or kinematics of its own is a
/// class of its own; the step knows none of them.
#pragma once
#include <memory>
#include <span>

#include "rondo/model/material_report.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::dynamics {

/// Fields are of all nodes (n), in the frame in which a node moves; those of clamped nodes are not
/// read and mean nothing.
class InternalForce {
 public:
  virtual ~InternalForce() = default;
  InternalForce() = default;
  InternalForce(const InternalForce&) = delete;
  InternalForce& operator=(const InternalForce&) = delete;

  /// Goes on to displacements u; what was found for those before is kept for the half step.
  virtual void evaluate(std::span<const Vec2> u) noexcept = 0;
  /// Derivative of the energy by the nodes' places at the last u: minus the force     [N/m]
  [[nodiscard]] virtual std::span<const Vec2> gradient() const noexcept = 0;
  /// Strain energy of (5.1), half a step before u, with the velocity v that led there   [J/m]
  [[nodiscard]] virtual double half_step_energy(std::span<const Vec2> u,
                                                std::span<const Vec2> v) const noexcept = 0;
  /// β times the rate of the gradient over the step that led to the last u            [N/m]
  virtual void damping(std::span<Vec2> out) noexcept = 0;
  /// (free_bodies) at the last u.
  [[nodiscard]] virtual std::span<const Pose> poses() const noexcept { return {}; }

  /// Of rubber, at the last u.
  [[nodiscard]] virtual MaterialReport material() const noexcept { return {}; }

  /// What it carries to the next step: force, gradient, energy, poses, and of rubber its branches
  /// and works.
  virtual void save(SavedState& saved) const = 0;
  virtual void restore(const SavedState& saved) = 0;
};

/// Of the model at displacements u_0: its own material's (Model::internal_force), else that of the
/// stiffness. The model must outlive it.
/// @param poses (free_bodies) from which whole turns are counted. @pre the assembled stiffness
[[nodiscard]] std::unique_ptr<InternalForce> make_internal_force(const Model& model,
                                                                 std::span<const Vec2> u0,
                                                                 std::span<const Pose> poses);

}  // namespace rondo::dynamics
