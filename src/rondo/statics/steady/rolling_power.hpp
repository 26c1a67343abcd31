// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where the power of steady rolling goes (docs/theory.md, 11.4): an identity to round-off,
/// so that it judges a solution from its whole field. In the plane it is per metre of width.
#pragma once
#include <vector>

#include "rondo/statics/steady/rolling_contact.hpp"

namespace rondo::statics {

/// drive + mass + stiffness + viscosity + friction - weight = scheme [W].
struct RollingPower {
  /// V·F + s T + φ V M_n: of speed, spin and yaw against the ground's forces
  double drive = 0.0;
  double mass = 0.0;       ///< taken by mass damping
  double stiffness = 0.0;  ///< taken by stiffness damping
  double viscosity = 0.0;  ///< taken by the branches of the material
  double friction = 0.0;   ///< taken by friction, by the slip that the law sees
  /// Given by gravity along the deformation; minus s times its torque about the center.
  double weight = 0.0;
  /// By which the velocity of the field differs from what the law sees: Σ r·(w - w_law).
  double scheme = 0.0;
  double residual = 0.0;  ///< what the identity leaves, over the largest of these          [-]
  /// |scheme| over the largest of |drive|, what damping takes, and |friction|: how much of the
  /// powers is of the discretisation. 0 where scheme is round-off                            [-]
  double scheme_share = 0.0;
  /// |scheme| over load times speed: the error of the coefficient of rolling resistance       [-]
  double scheme_over_load = 0.0;
  std::vector<double> by_part{};  ///< what each viscous part has of `viscosity` [W]

  /// Taken by damping and by the material.
  [[nodiscard]] double damping() const noexcept { return mass + stiffness + viscosity; }
};

/// Without friction and damping there is no power but round-off, which is not judged by itself: the
/// residual is over at least this share of load times speed.
inline constexpr double least_power_share = 1e-3;

/// Fills both shares of the scheme from the powers.
/// @param carried load times speed, >= 0: what there would be at a coefficient of 1
void find_scheme_shares(double carried, RollingPower& power) noexcept;

/// U_k of all rows under the solution's forces [m].
template <int D>
[[nodiscard]] Eigen::MatrixXcd spectrum_of(const RollingWindow<D>& window,
                                           const RollingSolution& solution);

/// @param remainder (D n_local, L) of inner forces beyond K u [N]; empty: none. Their power along
/// the deformation, which is 0 for a field that is resolved, is one of the scheme.
template <int D>
[[nodiscard]] RollingPower rolling_power(const RollingWindow<D>& window,
                                         const RollingSolution& solution,
                                         const Eigen::MatrixXcd& spectrum,
                                         const Eigen::MatrixXd& remainder = {});

}  // namespace rondo::statics
