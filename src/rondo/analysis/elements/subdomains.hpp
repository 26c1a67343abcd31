// SPDX-License-Identifier: BSD-3-Clause
/// @file  The two parts of a body that the scheme "hati" steps by themselves: which they are, what
/// they cannot be, and the critical step of the explicit one.
#pragma once
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Divides the body as [solver.hati] says, if the case has that scheme.
/// @throws InputError: nothing is left to be coarse; the parts do not meet, or at too many nodes; a
/// triangle by B-bar where they meet; what may touch the ground is not fine, or nearer than
/// solver.hati.ratio elements to what is not. @pre the model has all that depends on the body
void add_subdomains(const Case& c, Setup& s);

/// Critical step of the fine part alone, which nothing holds where it meets the coarse one
/// (docs/theory.md, 12.5).
/// @pre the body is divided
[[nodiscard]] dynamics::CriticalStep fine_part_step(const Setup& s,
                                                    dynamics::LaggedDamping damping);

}  // namespace rondo::study
