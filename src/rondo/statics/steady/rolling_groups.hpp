// SPDX-License-Identifier: BSD-3-Clause
/// @file  The contact of steady rolling on groups of pairs that carry one force each: a small
/// problem, whose solution is where to start from.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::statics {

/// Groups of up to four pairs of one candidate at samples one after the other, numbered in the
/// order of their first pairs.
template <int D>
struct RollingGroups {
  std::vector<std::size_t> of;  ///< (pairs) number of the group
  /// A pair a group: it has the sum of the forces and the means of the gaps and ways; its sample is
  /// a fourth of theirs.
  RollingProblem<D> problem;
  Eigen::VectorXd share;  ///< (groups) one over the pairs of each
};
template <int D>
[[nodiscard]] RollingGroups<D> grouped(const RollingProblem<D>& problem);

/// The forces of groups, in equal parts on their pairs.
template <int D>
[[nodiscard]] Eigen::VectorXd spread(const RollingGroups<D>& groups, const Eigen::VectorXd& force);
/// The forces of pairs, summed on their groups.
template <int D>
[[nodiscard]] Eigen::VectorXd gathered(const RollingGroups<D>& groups,
                                       const Eigen::VectorXd& force);
/// The mean factor of each group; empty: there are no factors of pairs.
template <int D>
[[nodiscard]] std::vector<PairFriction> gathered(const RollingGroups<D>& groups,
                                                 const std::vector<PairFriction>& pairs);

}  // namespace rondo::statics
