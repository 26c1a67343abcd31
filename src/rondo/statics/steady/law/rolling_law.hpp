// SPDX-License-Identifier: BSD-3-Clause
/// @file  The parts of Newton's method on steady rolling (rolling_newton.hpp) that depend on the
/// law of a pair. In the plane a pair has three statuses, so that Newton's method ends exactly or
/// cycles, and what cycles is a linear complementarity problem, which Lemke's pivoting solves. In
/// space the direction of sliding has a continuum of values, Newton's method converges, and what
/// does not is led by less friction, or swept pair by pair.
#pragma once
#include "rondo/statics/steady/rolling_newton.hpp"

namespace rondo::statics {

/// Statuses to start from. In the plane those that there are; else those of the solution on groups
/// of pairs. In space those of the forces without friction.
template <int D>
void begin(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& state);

/// In space: what sticks and slides, and where to, by the solution on groups of pairs with
/// friction.
/// @param state as begin() left it @return whether there is one
[[nodiscard]] bool refine(const RollingProblem<3>& problem, const RollingDrive& drive,
                          RollingState& state);

/// Newton's method; in the plane slopes too, if it ends in a solution.
template <int D>
void newton(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& state);
inline constexpr int most_newton_steps = 60;

/// Where Newton's method did not end, height and speed as they are.
template <int D>
void rescue(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& state);

/// With coefficients that follow from the state (rolling_friction.hpp). @pre the drive has a law
template <int D>
void solve_by_law(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& state);

/// Statuses by the law at the state's point.
template <int D>
void look(const RollingProblem<D>& problem, const RollingDrive& drive, RollingState& state);
/// Nothing has a force; statuses are those that the law says of that.
template <int D>
[[nodiscard]] RollingState without_forces(const RollingProblem<D>& problem,
                                          const RollingDrive& drive, const RollingPoint& point);
/// @param moved gaps and ways of the point
template <int D>
[[nodiscard]] double residual_of(const RollingProblem<D>& problem, const RollingPoint& point,
                                 const Eigen::VectorXd& moved, const PairCoefficients& friction);
[[nodiscard]] bool all_open(const RollingStatuses& statuses);
/// The torque, which is not linear, is as asked for to round-off: the square of what is left.
[[nodiscard]] bool is_near(const RollingPoint& point, const RollingPoint& before);

template <>
void begin(const RollingProblem<2>&, const RollingDrive&, RollingState&);
template <>
void newton(const RollingProblem<2>&, const RollingDrive&, RollingState&);
template <>
void rescue(const RollingProblem<2>&, const RollingDrive&, RollingState&);
template <>
void begin(const RollingProblem<3>&, const RollingDrive&, RollingState&);
template <>
void newton(const RollingProblem<3>&, const RollingDrive&, RollingState&);
template <>
void rescue(const RollingProblem<3>&, const RollingDrive&, RollingState&);

}  // namespace rondo::statics
