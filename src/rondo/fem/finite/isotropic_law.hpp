// SPDX-License-Identifier: BSD-3-Clause
/// @file  Isochoric energies of rubber in three dimensions (docs/rubber.md, 1.2): W of the
/// invariants or of the principal stretches of C̄ = J^(-2/3) C, with its derivatives by F.
#pragma once
#include <Eigen/Core>

#include "rondo/fem/rubber.hpp"

namespace rondo::fem::finite {

/// Entry iJ of a 3 × 3 matrix is number 3i + J.
struct IsochoricState {
  double energy = 0.0;                  ///< W                                        [Pa]
  Eigen::Vector<double, 9> stress;      ///< ∂W/∂F                                       [Pa]
  Eigen::Matrix<double, 9, 9> modulus;  ///< ∂²W/∂F²                                    [Pa]
};

/// @pre det F > 0
[[nodiscard]] IsochoricState isochoric_state(const Rubber& rubber, const Eigen::Matrix3d& f);

/// The first two alone. Not a number where det F <= 0.
struct IsochoricStress {
  double energy = 0.0;     ///< W                                                    [Pa]
  Eigen::Matrix3d stress;  ///< ∂W/∂F                                                   [Pa]
};
[[nodiscard]] IsochoricStress isochoric_stress(const Rubber& rubber, const Eigen::Matrix3d& f);

/// ∂J/∂F and ∂²J/∂F² of J = det F.
struct VolumeState {
  double ratio = 0.0;  ///< J
  Eigen::Vector<double, 9> slope;
  Eigen::Matrix<double, 9, 9> bend;
};
[[nodiscard]] VolumeState volume_state(const Eigen::Matrix3d& f);

}  // namespace rondo::fem::finite
