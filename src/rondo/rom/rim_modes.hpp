// SPDX-License-Identifier: BSD-3-Clause
/// @file  Coupling of a reduced body with a free rim: its rigid motions in addition to the modes
/// (docs/reduced.md, 12). Computed from the modes; model files do not contain it.
#pragma once
#include <Eigen/Core>
#include <span>

#include "rondo/mesh/mesh.hpp"

namespace rondo::rom {

struct ReducedModel;

/// Rectified frame, r modes Φ; sums over the nodes that are not bonded to the rim.
struct RimModes {
  double mass = 0.0;     ///< m = Σ m                                                    [kg/m]
  double inertia = 0.0;  ///< Σ m |X|²                                                   [kg·m]
  Eigen::MatrixXd carry;  ///< (r, r) D̃ = ½(D + K⁻¹D K): K D̃ is skew, so carrying takes no energy
  Eigen::MatrixXd turned_carry;  ///< (r, r) J D̃
  Eigen::MatrixXd carried_turn;  ///< (r, r) G = ΦᵀM𝒟JΦ, bitwise symmetric
};

/// @param mass (n) lumped, of all nodes. @pre the rectified frame; Φ is 0 on mesh.clamped
[[nodiscard]] RimModes make_rim_modes(const mesh::Mesh& mesh, std::span<const double> mass,
                                      const ReducedModel& model);

}  // namespace rondo::rom
