// SPDX-License-Identifier: BSD-3-Clause
/// @file  Pressure on boundary curves (docs/theory.md, 9.8): on the edges as they lie for a free
/// body, on a loaded rim and with rubber, so that a closed curve feels neither force nor moment; on
/// the reference edges, in the turning frame, where the rim follows its tables, as small strain has
/// it.
#pragma once
#include <span>
#include <vector>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Nodal forces at time t, in the nodes' frames, n each [N/m]: half of p L n an end of each edge,
/// those of clamped nodes among them.
void pressure_forces(const Model& model, std::span<const Vec2> u, double time,
                     std::span<Vec2> force) noexcept;

/// A force on a node of a body that is held, in the turning frame.
struct NodalLoad {
  int node = 0;
  int load = 0;  ///< place in Model::pressures
  Vec2 force{};  ///< per pressure                                                   [m]
};

/// All of them, by load, then by node: a node's force at time t is Σ pressure(t) · force. With
/// rubber on the undeformed edges, from which they depart.
/// @pre no body is free
[[nodiscard]] std::vector<NodalLoad> nodal_loads(const Model& model);

}  // namespace rondo::dynamics
