// SPDX-License-Identifier: BSD-3-Clause
/// @file  A node held by two facets (concave corner): its two contacts share the node's mass, so
/// they are one coupled problem, solved by block Gauss–Seidel with the closed-form block
/// (docs/theory.md, 4.4).
#pragma once
#include <array>

#include "rondo/contact/law.hpp"

namespace rondo::contact {

/// Unknowns are two impulses, each in its own contact frame.
struct PairProblem {
  std::array<Vec2, 2> free;  ///< relative velocities without impulses                    [m/s]
  std::array<double, 2> bounce{};  ///< as in LocalProblem                                   [m/s]
  Vec2 delassus;                   ///< W of the node, the same in both frames
  Vec2 turn;                       ///< conj(n_0) n_1: takes frame 1 to frame 0
};

struct PairSolution {
  std::array<LocalSolution, 2> contact;
  int iterations = 0;
  double residual = 0.0;  ///< law residual (residual.hpp) over the velocity scale, at the end
  bool converged = false;
};

/// Relative velocities that impulses give: w_i = free_i + Σ_j conj(n_i) W n_j r_j.
std::array<Vec2, 2> pair_velocities(const PairProblem& problem,
                                    const std::array<Vec2, 2>& impulse) noexcept;

/// Iterates from `start` to a residual of `tolerance`, at most `limit` times.
[[nodiscard]] PairSolution solve_pair(const PairProblem& problem, double friction,
                                      const std::array<Vec2, 2>& start, double tolerance = 1e-12,
                                      int limit = 1000) noexcept;

}  // namespace rondo::contact
