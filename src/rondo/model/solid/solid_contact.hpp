// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of one candidate of a wheel in three dimensions in one step, the counterpart of
/// contact_node.hpp (docs/wheel3d.md). The law is solved in the right-handed ground frame (n, J n,
/// t2), where J n is the tangent of contact/ground.hpp.
#pragma once
#include <array>
#include <span>

#include "rondo/contact/cone.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/model/contact_node.hpp"

namespace rondo::dynamics {

/// Data that all contacts of one step share. Vectors are in the non-rotating axes of the wheel.
struct SolidContactStep {
  /// @param axial_a A = 1 + Δt α/2 of the axial update
  SolidContactStep(const Model& model, const FrameStep& frame, const VelocityUpdate& update,
                   double axial_a) noexcept;
  /// For absolute velocities in the axes of the co-rotating frame, like that of ContactStep.
  SolidContactStep(const Model& model, const FrameStep& frame) noexcept;

  ContactStep plane;  ///< its center and rates are along t1 and n
  GroundFrame ground;
  double lateral;  ///< of c_{n+1}, along t2                                    [m]
  double axial_a;
  Vec3 center_rate;         ///< (c_{n+2} - c_{n+1})/Δt                        [m/s]
  Vec3 center_rate_before;  ///< (c_{n+1} - c_n)/Δt                            [m/s]
};

/// A candidate at t_{n+1}; vectors are in the co-rotating frame.
struct SolidContactNode {
  std::size_t candidate = 0;         ///< index in ContactModel::nodes
  double mass = 0.0;                 ///< [kg]
  double tributary = 0.0;            ///< [m²]
  Vec3 arm;                          ///< X + u_{n+1}                                   [m]
  Vec3 before;                       ///< v_{n+1/2}                                     [m/s]
  Vec3 free;                         ///< v_{n+3/2} without impulse                     [m/s]
  std::array<double, 2> pressure{};  ///< see ContactNode                          [Pa]
};

/// Position of a node along t1 and n, at which the ground is searched                [m]
inline Vec2 place_on_ground(const SolidContactStep& s, Vec3 arm) noexcept {
  return s.plane.center + s.ground.from_wheel(s.plane.rotation * arm).plane();
}

/// Counterpart of solve_contacts() in the plane. @pre touches.count is 1 or 2. Allocates nothing.
[[nodiscard]] Vec3 solve_contacts(const SolidContactStep& step, const SolidContactNode& node,
                                  const contact::Touches& touches,
                                  std::span<ActiveContact> contacts,
                                  ContactReport& report) noexcept;

}  // namespace rondo::dynamics
