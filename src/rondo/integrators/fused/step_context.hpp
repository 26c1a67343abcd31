// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the parts of a body share in one step, and how their sums become the ledger's.
#pragma once
#include <array>
#include <optional>
#include <span>

#include "rondo/integrators/fused/kernels/kernels.hpp"
#include "rondo/model/contact_node.hpp"
#include "rondo/model/solid/solid_contact.hpp"

namespace rondo::dynamics {

/// Factors of a step for the axial components alone.
struct AxialFactors {
  double pull = 0.0;     ///< Δt (c̈ - g) along the axle                              [m/s]
  double inverse = 0.0;  ///< 1/A, A = 1 + Δt α/2
  double drag = 0.0;     ///< Δt α
};

/// Frame, factors and contact of a step.
struct StepContext {
  FrameStep frame;
  kernels::StepFactors factors{};
  kernels::Terms terms;
  kernels::WheelFactors wheel{};  ///< instead of `factors`, with a loaded rim
  bool heavy = false;             ///< there is gravity, with a loaded rim
  std::optional<ContactStep> contact;
  AxialFactors axial;                             ///< in three dimensions
  std::optional<SolidContactStep> solid_contact;  ///< instead of `contact`, in three dimensions
  const double* pressures = nullptr;  ///< Model::pressures, or SolidBody::pressures, at t_n [Pa]
  /// (nb) candidates whose contacts are solved by HeldContact; null: none.
  const char* held = nullptr;
};

/// @param frame of the step, by the rim
StepContext step_context(const Model& model, const FrameStep& frame) noexcept;
/// Context of a step on a loaded rim; `back` + 1 turns the axes of the velocity before to its own.
/// @param gravity in the co-rotating frame                                       [m/s²]
StepContext wheel_context(const Model& model, const FrameStep& frame, Complex back,
                          Vec3 gravity) noexcept;

/// Raw sums: kernels::Sum, or kernels::WheelSum.
using StepSums = std::array<double, kernels::most_sums>;

/// Sum of all lanes of a kernel's sum, in pairs, so that few additions wait for others.
inline double sum_of_lanes(const double* x) noexcept {
  static_assert(kernels::lanes == 8);
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/// Pressure of a contact, for a law of friction that asks for it [Pa]. @param impulse r_n [N·s/m],
/// [N·s] @param tributary length or area of its node [m], [m²]; 0: none is known, and neither is
/// the pressure
inline double pressure_of(double impulse, double tributary, double dt) noexcept {
  return tributary > 0.0 ? impulse / (dt * tributary) : 0.0;
}

/// The results of a part of the body in one step: raw sums, and its contacts.
struct PartialStep {
  StepSums sums{};
  ContactReport contact;
};

/// Forces on a node, in the frame of its vectors [N/m], [N].
template <class Vec>
struct NodeForcesOf {
  Vec change{};  ///< K u_{n+1} - K u_n, with β only
  Vec load{};
  Vec elastic{};   ///< K u_{n+1}, with a loaded rim only
  Vec internal{};  ///< f at u_{n+1}, with nonlinear forces and no loaded rim only
  Vec moved{};     ///< u_{n+1} - u_n [m], with a loaded rim only
};
using NodeForces = NodeForcesOf<Vec2>;

/// Adds to the sums, which were made with the velocity free of contact, what the impulse changed.
/// @param node  arm, velocities before and without impulse; `after`: v⁺.
void correct_sums(const StepContext& step, const ContactNode& node, Vec2 after,
                  const NodeForces& forces, StepSums& sums) noexcept;
/// Does the same as correct_sums() with a loaded rim.
void correct_wheel_sums(const ContactNode& node, Vec2 after, const NodeForces& forces,
                        StepSums& sums) noexcept;

// In three dimensions. @param axes takes the vectors of the node to the co-rotating frame
void correct_sums(const StepContext& step, Complex axes, const SolidContactNode& node, Vec3 after,
                  const NodeForcesOf<Vec3>& forces, StepSums& sums) noexcept;
void correct_wheel_sums(Complex axes, const SolidContactNode& node, Vec3 after,
                        const NodeForcesOf<Vec3>& forces, StepSums& sums) noexcept;

/// The whole from its parts, in their order: compensated sums, as energies (5.1) and works (5.3).
struct WholeStep {
  StepEnergy energy;
  ContactReport contact;
  StepSums sums;
};
WholeStep whole_step(const Model& model, std::span<const PartialStep> parts) noexcept;

}  // namespace rondo::dynamics
