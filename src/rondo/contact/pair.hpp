// SPDX-License-Identifier: BSD-3-Clause
/// @file  A node held by two facets (concave corner): its two contacts share the node's mass, so
/// they are one coupled problem, solved exactly by cases (docs/theory.md, 4.4).
#pragma once
#include <array>

#include "rondo/contact/law.hpp"

namespace rondo::contact {

/// Unknowns are two impulses, each in its own contact frame.
struct PairProblem {
  std::array<Vec2, 2> free;          ///< relative velocities without impulses              [m/s]
  std::array<double, 2> bounce{};    ///< ε of each contact, see LocalProblem               [m/s]
  Complex delassus;                  ///< W of the node, the same in both frames            [m/kg]
  Complex turn;                      ///< conj(n_0) n_1: takes frame 1 to frame 0; not ±1
  std::array<double, 2> friction{};  ///< μ >= 0 of each contact                              [-]
};

struct PairSolution {
  std::array<LocalSolution, 2> contact;
  double residual = 0.0;   ///< law residual (residual.hpp) over m max|free|
  bool converged = false;  ///< residual <= tolerance
};

/// Relative velocities that impulses give: w_i = free_i + W Σ_j conj(n_i) n_j r_j.
std::array<Vec2, 2> pair_velocities(const PairProblem& problem,
                                    const std::array<Vec2, 2>& impulse) noexcept;

/// The cases in turn: both open, one alone, both pressing. With both pressing, two normal
/// velocities are known, so the whole velocity is, and with it the total impulse, which is then
/// shared out. The first case that the law's residual accepts is taken; else the one with the
/// smallest residual.
[[nodiscard]] PairSolution solve_pair(const PairProblem& problem,
                                      double tolerance = 1e-12) noexcept;

}  // namespace rondo::contact
