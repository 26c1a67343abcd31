// SPDX-License-Identifier: BSD-3-Clause
/// @file  Implicit elements of a case: which they are, what they cannot be combined with, and the
/// critical step of the others.
#pragma once
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Finds the elements of [[solver.implicit]], if there are any, and gives the model their
/// stiffness. @throws InputError: none chosen, or what they cannot do. @pre the model has all that
/// depends on the body
void add_implicit(const Case& c, Setup& s);

/// Critical step of explicit elements, with the mass of all (docs/theory.md, 3.9); infinite where
/// there are none. @pre the model has implicit elements
[[nodiscard]] dynamics::CriticalStep explicit_part_step(const Setup& s,
                                                        dynamics::LaggedDamping damping);

}  // namespace rondo::study
