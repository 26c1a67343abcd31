// SPDX-License-Identifier: BSD-3-Clause
/// @file  The step of the reduced equations at one spin as dense matrices: implicit midpoint rule
/// or explicit central differences (docs/reduced.md, 4).
#pragma once
#include <Eigen/Core>

#include "rondo/rom/reduced_model.hpp"

namespace rondo::rom {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

enum class StepScheme {
  midpoint,  ///< implicit, unconditionally stable; q and p both at whole steps
  central,   ///< explicit central differences; p at half steps
};

/// The parameters on which the matrices depend.
struct StepMatrixKey {
  StepScheme scheme = StepScheme::midpoint;
  double dt = 0.0;                 ///< Δt                                              [s]
  double mass_damping = 0.0;       ///< α                                               [1/s]
  double stiffness_damping = 0.0;  ///< β                                               [s]
  double carry = 0.0;      ///< s, counter-clockwise, mean over the step: carries the fields [rad/s]
  double spin = 0.0;       ///< s in the velocity equation; midpoint: the same as carry      [rad/s]
  double spin_rate = 0.0;  ///< ṡ                                                       [rad/s2]

  bool operator==(const StepMatrixKey&) const = default;
};

/// Δt_c of central differences with these modes [s]. @param stiffness_damping β [s]
double critical_step(const rom::ReducedModel& model, double stiffness_damping);

class StepMatrices {
 public:
  /// The model must outlive it. Multiplies copies of its matrices: O(r³).
  StepMatrices(const rom::ReducedModel& model, const StepMatrixKey& key);

  [[nodiscard]] const StepMatrixKey& key() const noexcept { return key_; }
  /// A⁻¹: change of p at the end of a step due to a push on the modes.
  [[nodiscard]] const MatrixXd& push_inverse() const noexcept { return push_; }
  /// N; central: R = 2N - 1
  [[nodiscard]] const MatrixXd& carry() const noexcept { return carry_; }

  /// A step without contact. In: q, p (r) at its beginning, push (r) Δt F. Out: q and p at its end,
  /// and `carried`, p before the push: p itself; with `central`, moved to the end. Allocates
  /// nothing.
  void advance(const VectorXd& q, const VectorXd& p, const VectorXd& push, VectorXd& q_end,
               VectorXd& p_end, VectorXd& carried);

  /// For `central`, the velocity alone: from p at the time of q to p half a step later.
  void kick(const VectorXd& q, const VectorXd& p, const VectorXd& push, VectorXd& p_end);

  /// Response at the end of the step to impulses: pushes (r, k) on the modes -> dq, dp (r, k).
  void respond(const MatrixXd& pushes, MatrixXd& dq, MatrixXd& dp) const;
  /// Adds the response to a single push to q and p. Allocates nothing.
  void add_response(const VectorXd& push, VectorXd& q, VectorXd& p);

 private:
  void make_midpoint(const rom::ReducedModel& model);
  void make_central(const rom::ReducedModel& model);

  StepMatrixKey key_;
  MatrixXd carry_;   ///< (r, r) N = (I - Δt/2 s D)⁻¹; central: R = 2N - I, which turns by sΔt
  MatrixXd push_;    ///< (r, r) change of p at the end due to a push on the modes       (R.3)
  MatrixXd from_q_;  ///< (r, r) midpoint: Δt/2 L N, L = K - s² + ṡJ; central: -Δt push_ L
  MatrixXd from_p_;  ///< (r, r) central: p at the end from p at the beginning
  VectorXd work_, other_;  ///< (r)
};

}  // namespace rondo::rom
