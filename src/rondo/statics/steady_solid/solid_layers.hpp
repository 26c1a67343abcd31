// SPDX-License-Identifier: BSD-3-Clause
/// @file  A harmonic of a steadily rolling wheel in three dimensions (docs/wheel3d.md): rows as
/// many elements away from the contact candidates are a layer, which couples with the next ones
/// alone, whatever the section looks like. It is eliminated from the rim outwards, as in the plane
/// (steady/rolling_layers.hpp).
#pragma once
#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/statics/steady/rolling_layers.hpp"

namespace rondo::statics {

/// A block of K between a row of a layer and one of the same layer or of the one below, by their
/// places there.
struct SolidLayerEntry {
  Eigen::Index row = 0, column = 0;
  std::size_t shift = 1;  ///< of the sectors, plus 1
  Eigen::Matrix3d block;  ///< [N/m]
};

struct SolidLayer {
  std::vector<int> rows;  ///< of the sector
  std::vector<SolidLayerEntry> own, up;
  std::vector<double> mass;  ///< of each row                                            [kg]

  /// Of its unknowns.
  [[nodiscard]] Eigen::Index size() const noexcept { return 3 * std::ssize(rows); }
};

/// From the rim outwards; the last is that of the candidates, in their order.
/// @param candidates rows of the sector. @param mass (n) of the mesh's nodes [kg]
[[nodiscard]] std::vector<SolidLayer> solid_layers(const fem::SolidSector& stiffness,
                                                   std::span<const int> candidates,
                                                   std::span<const double> mass);

/// One harmonic, eliminated: Z_k = K(k)(1 + iksβ) + M(-(ks)² + iks(α + 2sJ₃) - s² P).
class SolidElimination {
 public:
  using Block = Eigen::MatrixXcd;

  /// The layers must outlive it. @pre no layer is singular once those below are gone
  SolidElimination(std::span<const SolidLayer> layers, const RollingOrder& order);

  /// Displacement of the last layer by a force on it [m/N].
  [[nodiscard]] const Block& surface() const noexcept { return surface_; }
  /// Of all rows by forces on all rows, (3 n_local) [m].
  [[nodiscard]] Eigen::VectorXcd solve(const Eigen::VectorXcd& force) const;
  /// Of each layer but the last: how it follows the next when nothing acts on it.
  [[nodiscard]] std::vector<Block>& transfers() noexcept { return transfers_; }

 private:
  [[nodiscard]] Block own(const SolidLayer& layer) const;
  [[nodiscard]] Block turned(std::size_t l) const;
  [[nodiscard]] Block solved(std::size_t l, Block right) const;
  void factorise(Block here);

  struct Factor {
    Block matrix;
    std::vector<int> pivots;
  };

  std::span<const SolidLayer> layers_;
  RollingOrder order_;
  std::complex<double> elastic_;  ///< 1 + iksβ
  std::vector<Factor> factors_;   ///< of each layer, once those below are gone
  std::vector<Block> transfers_;
  Block surface_;
};

/// Displacement of all rows, once those of the last layer are there. @param u (3 n_local)
void follow(std::span<const SolidLayer> layers, std::span<const Eigen::MatrixXcd> transfers,
            Eigen::Ref<Eigen::VectorXcd> u);

/// uᴴ M u and uᴴ K(k) u.
[[nodiscard]] RollingNorms norms_of(std::span<const SolidLayer> layers, const RollingOrder& order,
                                    const Eigen::Ref<const Eigen::VectorXcd>& u);

}  // namespace rondo::statics
