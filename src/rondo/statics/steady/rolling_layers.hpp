// SPDX-License-Identifier: BSD-3-Clause
/// @file  A harmonic of steady rolling, layer by layer (docs/theory.md, 11.1, and docs/wheel3d.md):
/// rows as many elements away from the contact candidates are a layer, which couples with the next
/// ones alone, whatever the section looks like. The dynamic stiffness of a sector is then
/// block-tridiagonal, and is eliminated from the rim outwards. D components a row; with D = 2 all
/// is per metre of width.
#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>
#include <vector>

#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/statics/steady/complex_lu.hpp"
#include "rondo/statics/steady/node_vector.hpp"

namespace rondo::statics {

/// A block of K between a row of a layer and one of the same layer or of the one below, by their
/// places there.
template <int D>
struct RollingEntry {
  Eigen::Index row = 0, column = 0;
  std::size_t shift = 1;  ///< of the sectors, plus 1
  NodeMatrix<D> block;    ///< [N/m]
};

/// Blocks of a stiffness in a layer and between it and the one below; of a place, shifts -1, 0, 1
/// one after the other.
template <int D>
struct RollingEntries {
  std::vector<RollingEntry<D>> own, up;
};

template <int D>
struct RollingLayer {
  std::vector<int> rows;                   ///< of the sector
  RollingEntries<D> elastic;               ///< of K
  std::vector<RollingEntries<D>> viscous;  ///< of the stiffness of each viscous part
  std::vector<double> mass;                ///< of each row                                  [kg]

  /// Number of its unknowns.
  [[nodiscard]] Eigen::Index size() const noexcept { return D * std::ssize(rows); }
};
template <int D>
using RollingLayers = std::vector<RollingLayer<D>>;

/// From the rim outwards; the last is that of the candidates, in their order.
/// @param candidates rows of the sector. @param mass (n) of the mesh's nodes [kg]
/// @param viscous parts whose rows are those of K, and whose blocks are where K has blocks
template <int D>
[[nodiscard]] RollingLayers<D> rolling_layers(
    const fem::SectorBlocks<D>& stiffness, std::span<const int> candidates,
    std::span<const double> mass,
    std::span<const fem::ViscousPart<fem::SectorBlocks<D>>> viscous = {});

/// What one harmonic multiplies: Z_k = K(k)(1 + iksβ) + Σ_p h_p V_p(k)
/// + M(-(ks)² + iks(α + 2sJ) - s² P), with J and P of the plane of the wheel, V_p the stiffness of
/// a viscous part and h_p = g_p(iks) - 1. Without inertia M multiplies -s² P alone.
struct RollingOrder {
  std::array<std::complex<double>, 3> turns;  ///< e^{ik 2π/N shift}
  double rate = 0.0;                          ///< ks; 0 of the highest of an even turn     [rad/s]
  double spin = 0.0;                          ///< s                                        [rad/s]
  double mass_damping = 0.0;                  ///< α                                          [1/s]
  double stiffness_damping = 0.0;             ///< β                                            [s]
  bool inertia = true;                        ///< the masses resist acceleration and drag
  std::vector<std::complex<double>> viscous{};  ///< h_p of each viscous part
};

/// Numbers of the blocks T_l, (size of l, size of l + 1), one after the other, by which a layer
/// follows the next when nothing acts on it: u_l = T_l u_(l+1).
template <int D>
[[nodiscard]] std::size_t transfer_size(const RollingLayers<D>& layers);

/// Not finite where a layer is singular once those below are gone.
/// @param transfers (transfer_size) T_l, column-major
/// @return displacement of the last layer by a force on it [m/N]
template <int D>
[[nodiscard]] Eigen::MatrixXcd eliminate(const RollingLayers<D>& layers, const RollingOrder& order,
                                         std::span<std::complex<double>> transfers);

/// Factors of one harmonic, for forces on all rows.
template <int D>
class RollingFactors {
 public:
  RollingFactors(const RollingLayers<D>& layers, const RollingOrder& order);

  /// Displacement of all rows. @param layers those of the factors @param force (D n_local) [N]
  [[nodiscard]] Eigen::VectorXcd solve(const RollingLayers<D>& layers,
                                       const Eigen::VectorXcd& force) const;

 private:
  RollingOrder order_;
  std::vector<ComplexLu<D, Eigen::Dynamic>> factors_;  ///< of each layer, those before it gone
};
/// Numbers of the factors of a harmonic.
template <int D>
[[nodiscard]] std::size_t factors_size(const RollingLayers<D>& layers);

/// Displacement of all rows, once those of the last layer are there. @param u (D n_local)
template <int D>
void follow(const RollingLayers<D>& layers, std::span<const std::complex<double>> transfers,
            Eigen::Ref<Eigen::VectorXcd> u);

/// uᴴ M u, uᴴ K(k) u and, of each viscous part, uᴴ V_p(k) u.
struct RollingNorms {
  double mass = 0.0, stiffness = 0.0;
  std::vector<double> viscous{};
};
template <int D>
[[nodiscard]] RollingNorms norms_of(const RollingLayers<D>& layers, const RollingOrder& order,
                                    const Eigen::Ref<const Eigen::VectorXcd>& u);

}  // namespace rondo::statics
