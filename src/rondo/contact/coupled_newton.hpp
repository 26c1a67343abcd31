// SPDX-License-Identifier: BSD-3-Clause
/// @file  Newton's method on the statuses of coupled contacts: where they are right, one linear
/// system is the solution (docs/theory.md, 4.7c). Used by solve_coupled only.
#pragma once
#include <span>

#include "rondo/contact/coupled.hpp"

namespace rondo::contact {

/// Orders the contacts so that coupled ones are near each other, into work.order, and returns the
/// largest distance of two coupled ones (Cuthill, McKee, Proc. 24th ACM Conf. (1969) 157).
int order_contacts(const CoupledProblem& problem, CoupledWorkspace& work);

/// Whether the matrix is small enough to be worth it.
bool newton_fits(const CoupledProblem& problem, int width) noexcept;

/// One step from `impulse`, which need not obey the cones, to the solution of the system of its
/// statuses; false where that has none.
bool newton_step(const CoupledProblem& problem, int width, std::span<Vec2> impulse,
                 CoupledWorkspace& work);

}  // namespace rondo::contact
