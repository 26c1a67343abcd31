// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a body whose inner forces are not linear (docs/tyre.md): the harmonics
/// have the linear part of the forces, what is left of them acts as a load, and contact is solved
/// exactly with that load, again and again until the load no longer changes.
#pragma once
#include <Eigen/Core>
#include <span>

#include "rondo/statics/steady/rolling_contact.hpp"

namespace rondo::statics {

/// What the inner forces of a body have beyond K u. Fields are (3 n_local, L): of all rows at all
/// samples, in the frames of the sectors.
class RollingRemainder {
 public:
  RollingRemainder() = default;
  RollingRemainder(const RollingRemainder&) = delete;
  RollingRemainder& operator=(const RollingRemainder&) = delete;
  virtual ~RollingRemainder() = default;

  /// @param u [m]. @param force [N]. @return false: an element is turned inside out
  [[nodiscard]] virtual bool find(const Eigen::MatrixXd& u, Eigen::MatrixXd& force) = 0;
  /// Factors the stiffness at u of the part near the ground, what is far away and what is pressed
  /// against the ground being held.
  virtual void take_stiffness(const Eigen::MatrixXd& u, std::span<const RollingPair> pressed) = 0;
  /// Moves that part towards its equilibrium, if it has factors. @param left out of balance at u
  /// [N]
  virtual void correct(const Eigen::MatrixXd& left, Eigen::MatrixXd& u) = 0;
  /// What is stored where find() was asked last, while sector 0 is where it is in X [J].
  [[nodiscard]] virtual double energy() const = 0;
};

struct FiniteEffort {
  int turns = 0;          ///< problems of contact that were solved
  int parts = 0;          ///< of the way to the height or the load
  double residual = 0.0;  ///< largest force that a row is out of balance by, over the load      [-]
};

/// A state, with its fields.
struct FiniteRolling {
  RollingSolution solution;
  Eigen::MatrixXcd spectrum;  ///< of all rows, (D n_local, L/2 + 1)                     [m]
  Eigen::MatrixXd u;          ///< its fields, (D n_local, L)                            [m]
  Eigen::MatrixXd remainder;  ///< the load that is in equilibrium with them, (D n_local, L)    [N]
  FiniteEffort effort;
};

/// Bound of the residual.
inline constexpr double finite_rolling_bound = 1e-8;

/// @param window of the harmonics, which keep their factors. @param near a state of the window at
/// another height or load, to start from; null: from where the body just touches
[[nodiscard]] FiniteRolling solve_finite_rolling(RollingWindow<3>& window,
                                                 const RollingDrive& drive,
                                                 RollingRemainder& remainder,
                                                 const FiniteRolling* near = nullptr);

}  // namespace rondo::statics
