// SPDX-License-Identifier: BSD-3-Clause
/// @file  The state with which the steps of a wheel in three dimensions begin: start() (start.hpp)
/// leaves it to this.
#pragma once
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// Adds to u_0, v_0 and the frame of t = 0 in a state: K u_0, its rate, and v_{1/2} by half a step
/// without contact. Clamped nodes rest.
void start_solid(const Model& model, State& state);

}  // namespace rondo::dynamics
