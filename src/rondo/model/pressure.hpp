// SPDX-License-Identifier: BSD-3-Clause
/// @file  Pressure on boundary curves (docs/theory.md, 9.8): on the edges as they lie for a free
/// body, so that a closed curve feels neither force nor moment; on the reference edges, in the
/// turning frame, for a body that is held, as small strain has it.
#pragma once
#include <span>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Nodal forces at time t, in the nodes' frames, n each [N/m]: half of p L n an end of each edge.
void pressure_forces(const Model& model, std::span<const Vec2> u, double time,
                     std::span<Vec2> force) noexcept;

}  // namespace rondo::dynamics
