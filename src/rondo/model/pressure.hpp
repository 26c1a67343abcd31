// SPDX-License-Identifier: BSD-3-Clause
/// @file  Pressure on boundary curves (docs/theory.md, 9.8). For a free body, on a loaded rim and
/// with rubber it acts on the deformed edges, so that a closed curve has neither force nor moment.
/// If the rim follows its tables, it acts on the reference edges in the rotating frame, as in
/// small-strain theory.
#pragma once
#include <span>
#include <vector>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Nodal forces at time t, in the nodes' frames, n each [N/m]: each end of an edge receives half of
/// p L n, also at clamped nodes.
void pressure_forces(const Model& model, std::span<const Vec2> u, double time,
                     std::span<Vec2> force) noexcept;

/// A force on a node of a constrained body, in the rotating frame.
struct NodalLoad {
  int node = 0;
  int load = 0;  ///< index in Model::pressures
  Vec2 force{};  ///< force per unit of pressure                                       [m]
};

/// All loads, by pressure, then by node: the force on a node at time t is Σ pressure(t) · force.
/// With rubber they are valid for the undeformed edges and change with the deformation.
/// @pre no body is free
[[nodiscard]] std::vector<NodalLoad> nodal_loads(const Model& model);

}  // namespace rondo::dynamics
