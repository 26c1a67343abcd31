// SPDX-License-Identifier: BSD-3-Clause
/// @file  Newton's method on the statuses of coupled contacts: where they are right, one linear
/// system is the solution (docs/theory.md, 4.7b). Used by solve_coupled only.
#pragma once
#include <span>

#include "rondo/contact/coupled/coupled.hpp"

namespace rondo::contact {

/// Orders the contacts so that coupled ones are near each other, into work.order, and returns the
/// largest distance of two coupled ones (Cuthill, McKee, Proc. 24th ACM Conf. (1969) 157).
int order_contacts(const CoupledProblem& problem, CoupledWorkspace& work);

struct NewtonSettings {
  int width = 0;       ///< result of order_contacts
  double shift = 0.0;  ///< W_jj + shift/m_j, for contacts that share what they hold       [-]
  int most_steps = 20;
  int halvings = 10;   ///< most halvings of a step that goes too far; 0: whole steps
  double scale = 0.0;  ///< scale of the impulses [N·s/m]
};

struct NewtonResult {
  int steps = 0;
  bool solved = false;  ///< the statuses are right for what the impulses became
};

/// Whether the matrix is small enough to be worth it.
bool newton_fits(const CoupledProblem& problem, int width) noexcept;

/// Solves the law for w + (shift/m)(r - r⁰), r⁰ what `impulse` comes in as. The impulses need not
/// obey the cones when they leave. @pre order_contacts
NewtonResult newton(const CoupledProblem& problem, const NewtonSettings& settings,
                    std::span<Vec2> impulse, CoupledWorkspace& work);

}  // namespace rondo::contact
