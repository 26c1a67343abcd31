// SPDX-License-Identifier: BSD-3-Clause
/// @file  The state with which the steps begin (docs/theory.md, 3.7).
#pragma once
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// State at t = 0 from u_0 and v_0 (n each, co-rotating frame): K u_0 and v_{1/2} by half a step
/// without contact (3.7). Displacements and velocities of clamped nodes are ignored.
/// @param half v_{1/2} where it is known (n), with the forces of contact in it; empty: (3.7)
State start(const Model& model, Field u0, Field v0, const Field& half = {});

}  // namespace rondo::dynamics
