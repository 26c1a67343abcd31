// SPDX-License-Identifier: BSD-3-Clause
/// @file  Displacements and velocities at t = 0, and whether bodies start where they may.
#pragma once
#include "rondo/analysis/build/build.hpp"

namespace rondo::study {

/// Fills u_0, v_0 and, of a start in steady rolling, v_{1/2}. @pre the step is chosen
/// @param shared keeps a stationary state, and gives the one it has for this spin; may be null.
/// @throws InputError: spin beyond the softening limit with a stationary start, motions that the
/// bodies cannot have
void set_initial_fields(const Case& c, Setup& s, SharedBody* shared = nullptr);

/// @throws InputError: bodies deeper than half an element inside the ground or each other. Less
/// deep is warned of. @pre the fields are set
void check_start(const Case& c, Setup& s);

}  // namespace rondo::study
