// SPDX-License-Identifier: BSD-3-Clause
/// @file  What `rondo check` tells of the obstacles and the friction of the ground, and warnings of
/// what the body does not meet.
#pragma once
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Adds lines and warnings to the setup. @pre s.mesh is made
void tell_ground(const Case& c, Setup& s);

}  // namespace rondo::study
