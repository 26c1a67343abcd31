// SPDX-License-Identifier: BSD-3-Clause
/// @file  Strains of the viscous branches of the modes of a harmonic (docs/reduced.md, R.33), by
/// the midpoint rule. A state has the coefficients y of the modes and their velocities p, one after
/// the other.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <span>

#include "rondo/fem/rubber.hpp"
#include "rondo/rom/wheel/base/wheel_outcome.hpp"

namespace rondo::rom {

/// The branches of the modes of a harmonic in a step.
struct BranchStep {
  std::span<const fem::ViscousBranch> branches;
  const Eigen::VectorXd& squares;  ///< (r) ω²                                           [1/s²]
  std::complex<double> turn;       ///< c = 1 + ½Δt iks
  double dt;                       ///< [s]

  /// Share of the middle velocity, times ½Δt, and of the strain at the start in the mean strain of
  /// a branch: (½Δt p_m + e)/(c + ½Δt/τ).
  [[nodiscard]] std::complex<double> share(std::size_t branch) const noexcept {
    return 1.0 / (turn + 0.5 * dt / branches[branch].time);
  }
  /// Adds what they resist the middle velocities with to the (r, r) matrix of the step.
  void add_to(Eigen::MatrixXcd& step) const;
};

struct BranchStrains {
  Eigen::MatrixXcd end;   ///< (r, branches) y less what the branch has followed of it
  Eigen::MatrixXcd mean;  ///< (r, branches) its mean over the last step

  BranchStrains(Eigen::Index modes, std::size_t branches)
      : end(Eigen::MatrixXcd::Zero(modes, static_cast<Eigen::Index>(branches))), mean(end) {}

  /// Takes from the middle velocities what the strains at the start of a step do to them, (r).
  void take_from(const BranchStep& step, Eigen::VectorXcd& velocities) const;
  /// Finds the strains at the end of a step. @param before, state (2r) at both ends of it
  void relax(const BranchStep& step, const Eigen::VectorXcd& before, const Eigen::VectorXcd& state);
  /// Adds what modes and branches store, what the branches take and the work against both.
  /// @param n weight of the harmonic, times the number of sectors
  void account(const BranchStep& step, const Eigen::VectorXcd& before,
               const Eigen::VectorXcd& state, double n, WheelEnergy& to) const;
};

}  // namespace rondo::rom
