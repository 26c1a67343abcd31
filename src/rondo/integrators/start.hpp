// SPDX-License-Identifier: BSD-3-Clause
/// @file  The state with which the steps begin (docs/theory.md, 3.7).
#pragma once
#include <vector>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// State at t = 0 from u_0 and v_0 (n each, turning frame): K u_0 and v_{1/2} by half a step
/// without contact (3.7). Displacements and velocities of clamped nodes are ignored.
/// @param half v_{1/2} where it is known (n), with the forces of contact in it; empty: (3.7)
/// @param axial of a wheel in three dimensions alone
State start(const Model& model, std::vector<Vec2> u0, std::vector<Vec2> v0,
            std::vector<Vec2> half = {}, const AxialStart& axial = {});

}  // namespace rondo::dynamics
