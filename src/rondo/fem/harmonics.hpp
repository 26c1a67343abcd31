// SPDX-License-Identifier: BSD-3-Clause
/// @file  Harmonics of a body of N equal sectors: fields whose polar components are multiplied by
/// e^{iκ}, κ = 2πk/N, from a sector to the next (docs/theory.md, 2.7). The equations of the body
/// decouple into one problem per harmonic, each of the size of one sector.
#pragma once
#include <Eigen/SparseCore>
#include <complex>
#include <span>
#include <vector>

#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::fem {

/// A(k) = M^-½ K(k) M^-½ with K(k) = K_0 + e^{iκ} K_1 + e^{-iκ} K_{-1} (2.7), Hermitian, for k = 0
/// … N/2; N - k has the conjugate matrix with the same eigenvalues. Component c of the sector's row
/// a has the number C a + c. With masses of 1 kg/m, A(k) is K(k).
class Harmonics {
 public:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  /// @param mass (n) of all nodes of the mesh; only those of sector 0 are used, > 0 [kg/m].
  template <int C>
  Harmonics(const SectorBlocks<C>& k, std::span<const double> mass);

  /// Number of harmonics: N/2 + 1, rounded down.
  [[nodiscard]] int count() const noexcept { return n_sectors_ / 2 + 1; }
  /// Size of a matrix: C n_local.
  [[nodiscard]] Eigen::Index size() const noexcept { return matrix_.rows(); }
  /// (C n_local) M^½ of the sector [√(kg/m)].
  [[nodiscard]] const Eigen::VectorXd& root_mass() const noexcept { return root_mass_; }

  /// Lower triangle of factor · A(k) + shift · I [1/s²]: one pattern for all, columns in order,
  /// each starting at its diagonal. The reference is to the object's only matrix and is valid until
  /// the next call. @pre 0 <= harmonic < count().
  const Matrix& lower(int harmonic, double factor, double shift) {
    return lower(harmonic, factor, shift, shift);
  }
  /// Takes another shift for the axial components: spin softens only those in the plane.
  const Matrix& lower(int harmonic, double factor, double shift, double axial_shift);

 private:
  int n_sectors_;
  int components_;  ///< C
  Eigen::VectorXd root_mass_;
  Matrix matrix_;
  /// An entry of A(k) = constant + even cos κ + i odd sin κ.
  struct Entry {
    double constant, even, odd;
  };
  std::vector<Entry> entries_;  ///< (nonzeros of matrix_)
};

}  // namespace rondo::fem
