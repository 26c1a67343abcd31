// SPDX-License-Identifier: BSD-3-Clause
/// @file  The implicit midpoint step of the reduced equations at one spin (docs/reduced.md, 4): the
/// inverse of its matrix, and the Delassus blocks of the contact points that have been needed.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "rondo/reduction/reduced_model.hpp"

namespace rondo::reduced {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What the matrices hang on.
struct StepMatrixKey {
  double dt = 0.0;                 ///< Δt                                              [s]
  double mass_damping = 0.0;       ///< α                                               [1/s]
  double stiffness_damping = 0.0;  ///< β                                               [s]
  double spin = 0.0;               ///< s̄, counter-clockwise, mean over the step          [rad/s]
  double spin_rate = 0.0;          ///< ṡ, likewise                                      [rad/s2]

  bool operator==(const StepMatrixKey&) const = default;
};

/// Law's velocities at a point from a unit impulse at another, both along x and y of the fixed
/// frame: normal parts are those of the place at the end of the step, tangential parts those of the
/// material there (R.4).
struct DelassusPair {
  Eigen::Matrix2d normal, tangential;  ///< [m/kg]
};

class SpinMatrices {
 public:
  /// The model must outlive it.
  SpinMatrices(const reduction::ReducedModel& model, const StepMatrixKey& key);

  [[nodiscard]] const StepMatrixKey& key() const noexcept { return key_; }
  /// (2r, 2r) S = (I - Δt/2 A)⁻¹ with ẏ = A y + F, y = (q, p): ȳ = S (y + Δt/2 F)        (R.3)
  [[nodiscard]] const MatrixXd& inverse() const noexcept { return inverse_; }
  /// Makes the blocks between all these points, where they are not there yet.
  void prepare(std::span<const int> points);
  /// @pre both points were prepared
  [[nodiscard]] DelassusPair pair(int at, int from) const noexcept;

 private:
  void add(int point);

  const reduction::ReducedModel& model_;
  StepMatrixKey key_;
  MatrixXd inverse_;
  MatrixXd place_rows_;     ///< (2m, r) s̄ H D: velocity of a place that stands still in space
  std::vector<int> slot_;   ///< (m) -1: not there
  std::vector<int> known_;  ///< points in the order of the slots
  MatrixXd response_;       ///< (2r, 2 slots) change of y at the end of the step
  MatrixXd normal_, tangential_;  ///< (2 slots, 2 slots)
};

}  // namespace rondo::reduced
