// SPDX-License-Identifier: BSD-3-Clause
/// @file  What `rondo check` tells of the obstacles and the friction of the ground, and warnings of
/// what the body does not meet.
#pragma once
#include "rondo/analysis/build/build.hpp"

namespace rondo::study {

/// Adds lines and warnings to the setup. @pre s.mesh is made
/// @param steps those of a reduced wheel know the pressures of a start in steady rolling
void tell_ground(const Case& c, Steps steps, Setup& s);

}  // namespace rondo::study
