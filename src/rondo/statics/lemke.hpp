// SPDX-License-Identifier: BSD-3-Clause
/// @file  Linear complementarity by Lemke's method (Cottle, Pang, Stone, The Linear
/// Complementarity Problem, Academic Press 1992, section 4.4; docs/theory.md, 6.4).
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rondo::statics {

enum class LemkeEnd {
  solved,
  ray,    ///< no solution found; for some classes of matrices there is none then
  limit,  ///< of pivots, or a number that is not finite
};

struct LemkeReport {
  LemkeEnd end = LemkeEnd::limit;
  int pivots = 0;
};

struct LcpSolution {
  Eigen::VectorXd z;        ///< (n) to the round-off of the pivots; all zero where none was found
  std::vector<char> basic;  ///< (n) 1: z_i solves y_i = 0, 0: z_i = 0
};

/// 0 <= z ⊥ y = q + M z >= 0; M and q of order 1 are wanted. Ties are broken lexicographically, so
/// that no basis comes twice.
struct Lcp {
  Eigen::MatrixXd matrix;  ///< (n, n) M
  Eigen::VectorXd q;       ///< (n)
  Eigen::VectorXd cover;   ///< (n) > 0, the covering vector: what the artificial variable adds to y
};

/// @param max_pivots of the order of 10 n
[[nodiscard]] LemkeReport solve_lemke(const Lcp& lcp, int max_pivots, LcpSolution& solution);

}  // namespace rondo::statics
