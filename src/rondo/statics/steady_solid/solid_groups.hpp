// SPDX-License-Identifier: BSD-3-Clause
/// @file  The contact of steady rolling in three dimensions on groups of pairs that carry one force
/// each, as in the plane (steady/rolling_problem.hpp): a small problem, whose solution is where to
/// start from.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/statics/steady_solid/solid_problem.hpp"

namespace rondo::statics {

/// Groups of up to four pairs of one candidate at samples one after the other.
struct SolidGroups {
  std::vector<std::size_t> of;  ///< (pairs) number of the group
  SolidRollingProblem problem;  ///< a pair a group: sums of forces, means of gaps and ways
  Eigen::VectorXd share;        ///< (groups) one over the pairs of each
};
[[nodiscard]] SolidGroups grouped(const SolidRollingProblem& problem);

/// The forces of groups, in equal parts on their pairs.
[[nodiscard]] Eigen::VectorXd spread(const SolidGroups& groups, const Eigen::VectorXd& force);
/// Of pairs, on their groups.
[[nodiscard]] Eigen::VectorXd gathered(const SolidGroups& groups, const Eigen::VectorXd& force);

}  // namespace rondo::statics
