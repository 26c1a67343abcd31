// SPDX-License-Identifier: BSD-3-Clause
/// @file  A contact at a sharp corner of the ground in three dimensions, or at a node that such a
/// contact also pushes: contact_row.hpp with two tangential directions (docs/wheel3d.md).
#pragma once
#include "rondo/contact/coupled/spatial_coupled.hpp"
#include "rondo/integrators/general/contact_row.hpp"

namespace rondo::dynamics {

/// Rows on the velocities of its nodes, in the axes of the wheel: w = Σ H_i V_i, along n, J n and
/// the edges of the ground.
struct CornerRow {
  ContactKind kind = ContactKind::facet;  ///< facet or corner
  int count = 0;                          ///< nodes: 1 of a facet, 2 of a corner
  std::array<int, 2> node{};
  std::array<contact::SpatialBlock, 2> block{};  ///< H_i; H_iᵀ r is the impulse on the node
  std::array<double, 2> weight{};                ///< of the nodes in the place that touches
  std::size_t set = 0;       ///< profile of the ground, see profile_count() of wheel_ground.hpp
  std::uint64_t key = 0;     ///< name of the contact, the same in the next step
  Vec2 normal;               ///< in the plane of the profile; what r acts on is pushed along it
  Vec2 point;                ///< that touches, in the plane of the profile      [m]
  double gap = 0.0;          ///< <= 0                                          [m]
  double tributary = 0.0;    ///< [m²]; of a corner 0
  double turning = 0.0;      ///< see ContactRow                                [m/s]
  Vec3 before, free, after;  ///< w⁻, w without impulses, w⁺                    [m/s]
  double bounce = 0.0;       ///< ε of the law (4.3)                            [m/s]
  double friction = 0.0;     ///< μ of the law                                  [-]
  Vec3 impulse;              ///< r                                             [N·s]
  contact::Status status = contact::Status::open;
};

}  // namespace rondo::dynamics
