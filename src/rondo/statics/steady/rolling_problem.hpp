// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a steadily rolling body as dense linear algebra (docs/theory.md, 11.2): gaps
/// and ways of pairs are linear in the forces of all. The same problem on groups of pairs that
/// carry one force each is a small one, whose solution is where to start from.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace rondo::statics {

/// A candidate at a sample; at sample 0 its sector is where it is in the reference.
struct RollingPair {
  std::size_t candidate = 0;
  int sample = 0;
};

struct RollingProblem {
  std::vector<RollingPair> pairs;
  double time = 0.0;  ///< of a sample                                                         [s]
  double pass = 1.0;  ///< P, of a sector: forces are sums over the pairs by it
  /// Of each pair (gap, way) without forces, the center at height 0 and at rest: gap + h and way +
  /// V time are those of a moving one. (2 pairs) [m]
  Eigen::VectorXd base;
  /// Of (gap, way) by (r_n, r_x): rows and columns 2j, 2j + 1 of pair j. (2 pairs, 2 pairs) [m²/N]
  Eigen::MatrixXd matrix;
  Eigen::VectorXd base_x;    ///< (pairs) place along x from the center, without forces [m]
  Eigen::MatrixXd matrix_x;  ///< (pairs, 2 pairs) and by them [m²/N]
  /// Torque of the weight about the center without forces [N], and by those of all pairs.
  double base_weight = 0.0;
  Eigen::VectorXd weight;  ///< (2 pairs) [m]
};

/// Forces on all pairs, height and speed of the center.
struct RollingPoint {
  Eigen::VectorXd force;  ///< (2 pairs) r_n, r_x                                            [N/m]
  double height = 0.0, speed = 0.0;
};

/// (gap, way) of all pairs.
[[nodiscard]] Eigen::VectorXd gaps_and_ways(const RollingProblem& problem,
                                            const RollingPoint& point);

/// Of the ground on the body, means over a sector's pass.
struct RollingForces {
  double x = 0.0, y = 0.0;  ///< [N/m]
  double torque = 0.0;  ///< about the center, counter-clockwise, with that of the weight      [N]
};
[[nodiscard]] RollingForces forces_of(const RollingProblem& problem, const RollingPoint& point);

/// Groups of up to four pairs of one candidate at samples one after the other.
/// @return of each pair its group, groups numbered in the order of their first pairs
[[nodiscard]] std::vector<std::size_t> groups_of(const RollingProblem& problem);
/// A pair a group: the sum of its forces, the means of its gaps and ways; its sample is a fourth of
/// theirs.
[[nodiscard]] RollingProblem grouped(const RollingProblem& problem,
                                     const std::vector<std::size_t>& groups);

}  // namespace rondo::statics
