// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of one candidate of a wheel in three dimensions in one step, as contact_node.hpp
/// has it in the plane (docs/wheel3d.md). The law is solved in the frame (n, J n, t2) of the
/// ground, right-handed, J n being the tangent of contact/ground.hpp.
#pragma once
#include <span>

#include "rondo/contact/cone.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/model/contact_node.hpp"

namespace rondo::dynamics {

/// What the contacts of one step share. Vectors in the axes of the wheel, which do not turn.
struct SolidContactStep {
  /// @param axial_a A = 1 + Δt α/2 of the axial update
  SolidContactStep(const Model& model, const FrameStep& frame, const VelocityUpdate& update,
                   double axial_a) noexcept;
  /// Of absolute velocities in the axes of the co-rotating frame, as ContactStep.
  SolidContactStep(const Model& model, const FrameStep& frame) noexcept;

  ContactStep plane;  ///< center and its rates are along t1 and n
  GroundFrame ground;
  double axial_a;
  Vec3 center_rate;         ///< (c_{n+2} - c_{n+1})/Δt                        [m/s]
  Vec3 center_rate_before;  ///< (c_{n+1} - c_n)/Δt                            [m/s]
};

/// A candidate at t_{n+1}, vectors in the turning frame.
struct SolidContactNode {
  std::size_t candidate = 0;  ///< place in ContactModel::nodes
  double mass = 0.0;          ///< [kg]
  double tributary = 0.0;     ///< [m²]
  Vec3 arm;                   ///< X + u_{n+1}                                   [m]
  Vec3 before;                ///< v_{n+1/2}                                     [m/s]
  Vec3 free;                  ///< v_{n+3/2} without impulse                     [m/s]
};

/// Place of a node along t1 and n: where the ground is looked for.                   [m]
inline Vec2 place_on_ground(const SolidContactStep& s, Vec3 arm) noexcept {
  return s.plane.center + s.ground.from_wheel(s.plane.rotation * arm).plane();
}

/// As solve_contacts() in the plane. @pre touches.count is 1 or 2. Allocates nothing.
[[nodiscard]] Vec3 solve_contacts(const SolidContactStep& step, const SolidContactNode& node,
                                  const contact::Touches& touches,
                                  std::span<ActiveContact> contacts,
                                  ContactReport& report) noexcept;

}  // namespace rondo::dynamics
