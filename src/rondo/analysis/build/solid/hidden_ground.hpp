// SPDX-License-Identifier: BSD-3-Clause
/// @file  Ground that a wheel in three dimensions does not feel, because its contact is at its
/// nodes alone (docs/theory.md, 4.1).
#pragma once
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Adds a warning if the forces depend on where the nodes happen to be.
/// @throws InputError: an obstacle, or a corner of one, may stand between the nodes
/// @pre model.solid
void check_hidden_ground(const Case& c, Setup& s);

}  // namespace rondo::study
