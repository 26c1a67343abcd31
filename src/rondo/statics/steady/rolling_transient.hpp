// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rolling that is not steady, without time (docs/theory.md, 11.6): in each step all points
/// of the body pass from one sample to the next, and the way of a point along the ground is counted
/// from where the forces of the step before had moved it. A steady state is a fixed point.
/// Source: J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, 1990, 5.2.2.5.
#pragma once
#include "rondo/core/contract.hpp"
#include "rondo/statics/steady/rolling_contact.hpp"

namespace rondo::statics {

/// From now on the ways of all pairs are counted from the displacements by these forces.
/// @param force (D pairs) of the step before [N]. @pre the problem has `upstream` and `before`
template <int D>
void roll_on_from(RollingProblem<D>& problem, const Eigen::VectorXd& force) {
  RONDO_DEMAND(force.size() == problem.size() && problem.before.size() == problem.size() &&
                   problem.upstream.rows() == problem.size(),
               force.size());
  problem.base -= problem.upstream * (force - problem.before);
  problem.before = force;
}

/// A step of a wheel by one sample, from a state on. @param window of SlipDifference::transient
/// @param before a solution of this window, or of a steady one whose pairs it has, in their order
[[nodiscard]] inline RollingSolution roll_on(RollingWindow<3>& window, const RollingDrive& drive,
                                             const RollingSolution& before) {
  window.roll_on_from(before.force);
  return solve_rolling_from(window, drive, before);
}

}  // namespace rondo::statics
