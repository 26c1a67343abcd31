// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady rolling of a body whose inner forces are not linear (docs/tyre.md): Newton's
/// method around the exact linear problem of contact. The harmonics have the linear part of the
/// forces, what is left of them acts as a load, and tangents at the samples of a pass say how much
/// softer the body is than the harmonics have it.
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
  /// @return K u [N]
  [[nodiscard]] virtual Eigen::MatrixXd linear(const Eigen::MatrixXd& u) = 0;
  /// Factors the tangent at u, with all its parts. @param pairs that may touch. @return false: it
  /// is not positive definite, and the factors from before are gone
  [[nodiscard]] virtual bool take_tangent(const Eigen::MatrixXd& u,
                                          std::span<const RollingPair> pairs) = 0;
  /// u += what the tangent makes of a force. @param force [N]
  virtual void move(const Eigen::MatrixXd& force, Eigen::MatrixXd& u) = 0;
  /// What a force on a pair moves another by at the tangent, less what it does at K, in the frames
  /// of their sectors [m/N]; 0 for pairs that were not given.
  [[nodiscard]] virtual Eigen::Matrix3d softness(const RollingPair& of,
                                                 const RollingPair& by) const = 0;
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
  Eigen::MatrixXd own_remainder;  ///< that of the fields themselves, (D n_local, L)            [N]
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
