// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of one candidate of a wheel in three dimensions in one step, the counterpart of
/// contact_node.hpp (docs/wheel3d.md). The law is solved in the frame of the touch, which is (n, J
/// n, t2) where the ground is a profile.
#pragma once
#include <array>
#include <span>

#include "rondo/contact/cone.hpp"
#include "rondo/contact/space/space_ground.hpp"
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

/// Position of a node along t1, n and t2                                              [m]
inline Vec3 place_in_space(const SolidContactStep& s, Vec3 arm) noexcept {
  return Vec3(s.plane.center, s.lateral) + s.ground.from_wheel(s.plane.rotation * arm);
}

/// Effect of a node's impulses on its velocity in the next step, in the axes of the wheel.
struct SolidMobility {
  Complex plane;  ///< [1/kg]
  double axial;

  /// @param mass of the node [kg]
  SolidMobility(const SolidContactStep& step, double mass) noexcept
      : plane(step.plane.turn / (mass * step.plane.a)), axial(1.0 / (mass * step.axial_a)) {}
  [[nodiscard]] Vec3 operator*(Vec3 r) const noexcept { return {plane * r.plane(), axial * r.z}; }
};

// Counterparts of those in the plane, in the axes of the wheel [m/s]:
/// b of (4.2). @param arm X + u_{n+1}, co-rotating frame [m]
[[nodiscard]] Vec3 drive_of(const SolidContactStep& step, Vec3 arm) noexcept;
/// (x_{n+1} - x_n)/Δt. @param before v_{n+1/2}, co-rotating frame [m/s]
[[nodiscard]] Vec3 velocity_before(const SolidContactStep& step, Vec3 arm, Vec3 before) noexcept;
/// Change of v_{n+3/2} by an impulse of these axes, co-rotating frame. @param mass [kg]
[[nodiscard]] Vec3 velocity_change(const SolidContactStep& step, double mass,
                                   Vec3 impulse) noexcept;

/// Adds what an impulse on a node does to the body. @param arm of the node, and `push`: axes of
/// the wheel [m], [N·s]
void add_impulse(const SolidContactStep& step, Vec3 arm, Vec3 push, ContactReport& report) noexcept;

/// Counterpart of solve_contacts() in the plane. @pre touches.count is 1 or 2. Allocates nothing.
[[nodiscard]] Vec3 solve_contacts(const SolidContactStep& step, const SolidContactNode& node,
                                  const contact::SpaceTouches& touches,
                                  std::span<ActiveContact> contacts,
                                  ContactReport& report) noexcept;

}  // namespace rondo::dynamics
