// SPDX-License-Identifier: BSD-3-Clause
/// @file  Effect of contact impulses if the rim is free to move (docs/reduced.md, 12).
#pragma once
#include <Eigen/Core>
#include <array>

#include "rondo/rom/contact_table.hpp"

namespace rondo::rom {

/// For pushes h on the modes (r) and d on the rim with the body (3), z = inverse (d - backᵀ h) is
/// the change of the rim's velocity at the end of the step. The change of p there is A⁻¹h -
/// velocity z, that of q likewise.
struct RimResponse {
  std::array<VectorXd, 3> velocity, displacement;  ///< (r) columns of A⁻¹B, Δt/2 N A⁻¹B
  std::array<VectorXd, 3> back;  ///< (r) of A⁻ᵀCᵀ; 0 for prescribed components
  Eigen::Matrix3d inverse;       ///< (D - C A⁻¹B)⁻¹; 1 for prescribed components
  Eigen::Vector3d free;          ///< 1: free, 0: prescribed

  /// z
  [[nodiscard]] Eigen::Vector3d change(const VectorXd& modes, const Eigen::Vector3d& direct) const;
};

/// The response at a contact point: velocity in the law due to z, and z of impulses along x and y.
struct PointResponse {
  Eigen::Matrix<double, 2, 3> normal, tangential;
  Eigen::Matrix<double, 3, 2> push;
};

/// @param arm X + u of the point at the end of the step, @param push_arm that of impulses [m]
/// @param spin s of the fields at points fixed in space
[[nodiscard]] PointResponse point_response(const RimResponse& rim, const ContactTable& table,
                                           int point, Vec2 arm, Vec2 push_arm, double spin);

}  // namespace rondo::rom
