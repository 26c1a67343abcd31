// SPDX-License-Identifier: BSD-3-Clause
/// @file  A harmonic of steady rolling, layer by layer (docs/theory.md, 11.1): the dynamic
/// stiffness of a sector is block-tridiagonal, and is eliminated from the rim outwards.
#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::statics {

/// Rows of the same distance from the center. Blocks by shift -1, 0, 1 of the sectors [N/m²].
struct RollingLayer {
  Eigen::Index first = 0, size = 0;  ///< of the rows' numbers, two a row
  std::array<Eigen::MatrixXd, 3> own;
  std::array<Eigen::MatrixXd, 3> up;  ///< (size, size of the layer below)
  std::vector<double> mass;           ///< of each row                                     [kg/m]
};

/// From the rim outwards. @param reference (n) X [m]. @param mass (n) [kg/m]
[[nodiscard]] std::vector<RollingLayer> rolling_layers(const fem::SectorStiffness& stiffness,
                                                       std::span<const Vec2> reference,
                                                       std::span<const double> mass);

/// What one harmonic multiplies: Z_k = K(k)(1 + iksβ) + M(-(ks)² + iks(α + 2sJ) - s²).
struct RollingOrder {
  std::array<std::complex<double>, 3> turns;  ///< e^{ik 2π/N shift}
  double rate = 0.0;                          ///< ks; 0 of the highest of an even turn     [rad/s]
  double spin = 0.0;                          ///< s                                        [rad/s]
  double mass_damping = 0.0;                  ///< α                                          [1/s]
  double stiffness_damping = 0.0;             ///< β                                            [s]
};

/// Numbers of the blocks T_l, (size of l, size of l + 1), one after the other, by which a layer
/// follows the next when nothing acts on it: u_l = T_l u_(l+1).
[[nodiscard]] std::size_t transfer_size(std::span<const RollingLayer> layers);

/// @param transfers (transfer_size) T_l, column-major
/// @return displacement of the last layer by a force on it [m²/N]
[[nodiscard]] Eigen::MatrixXcd eliminate(std::span<const RollingLayer> layers,
                                         const RollingOrder& order,
                                         std::span<std::complex<double>> transfers);

/// Displacement of all rows by forces on all rows. @param force (2 n_local) [N/m]
[[nodiscard]] Eigen::VectorXcd solve(std::span<const RollingLayer> layers,
                                     const RollingOrder& order, const Eigen::VectorXcd& force);

/// Of all rows, once those of the last layer are there. @param u (2 n_local)
void follow(std::span<const RollingLayer> layers, std::span<const std::complex<double>> transfers,
            std::span<std::complex<double>> u);

/// uᴴ M u and uᴴ K(k) u.
struct RollingNorms {
  double mass = 0.0, stiffness = 0.0;
};
[[nodiscard]] RollingNorms norms_of(std::span<const RollingLayer> layers, const RollingOrder& order,
                                    const Eigen::Ref<const Eigen::VectorXcd>& u);

}  // namespace rondo::statics
