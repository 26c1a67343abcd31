// SPDX-License-Identifier: BSD-3-Clause
/// @file  Coefficients of friction in steady rolling that depend on slip speed and pressure
/// (docs/theory.md, 11.7). Each pair has the coefficient of its own slip speed and pressure.
/// Method: with given coefficients the contact is the exact Coulomb problem (rolling_newton.hpp);
/// the coefficients are iterated on, along the tangent of the law, or by Anderson's acceleration
/// where that gains nothing. Friction that falls with the slip speed has several solutions: the one
/// that is reached from the constant coefficient is returned, with a share of the departure from it
/// that grows from 0 to 1 in steps.
#pragma once
#include <vector>

#include "rondo/contact/friction_table.hpp"
#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::statics {

struct RollingFriction {
  /// Factors of the drive's μ: its coefficient is 1. A steady state has no place on the ground, so
  /// that there are no patches.
  contact::FrictionTable table;
  std::vector<double> extent;  ///< (candidates) length, in space area, of a node [m], [m²]
};

/// Largest change of a coefficient by its own state, at the end.
inline constexpr double coefficient_bound = 1e-10;

/// Friction of all pairs by their slip speed and pressure at a point, linearised about it.
/// @param share of the departure of the factors from 1. @pre the drive has a law
template <int D>
[[nodiscard]] std::vector<PairFriction> frictions_at(const RollingProblem<D>& problem,
                                                     const RollingDrive& drive,
                                                     const RollingPoint& point, double share = 1.0);

}  // namespace rondo::statics
