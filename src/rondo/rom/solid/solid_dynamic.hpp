// SPDX-License-Identifier: BSD-3-Clause
/// @file  Matrices of the harmonics of a wheel in three dimensions: its stiffness, and what a
/// pattern of forces that stands still in space meets (docs/reduced3d.md, R.36).
#pragma once
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <array>
#include <complex>
#include <memory>
#include <vector>

#include "rondo/rom/solid/solid_ring.hpp"
#include "rondo/rom/wheel/base/ring_rows.hpp"

namespace rondo::rom {

using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;
using SparseFactor = Eigen::SimplicialLDLT<SparseComplex, Eigen::Lower, Eigen::AMDOrdering<int>>;

/// K(k) of a ring at all k, from the three matrices that couple a sector with its neighbours.
class HarmonicStiffness {
 public:
  explicit HarmonicStiffness(const fem::SolidSector& of);
  [[nodiscard]] SparseComplex at_harmonic(int k) const;

 private:
  int n_;
  std::array<SparseComplex, 3> parts_;  ///< by the shift, from -1
};

/// Z_k of an elastic ring and of its modes, at the rate ks and the spin s.
class StandingAnswer {
 public:
  /// @param h null: no modes @param inertia share of it that is counted
  StandingAnswer(const SolidRing& ring, const SparseComplex& stiffness, const RingHarmonic* h,
                 double spin, double rate, double inertia = 1.0);
  /// The convected form says what a pattern does that came from rest only if no mode that is left
  /// out has passed its critical spin.
  [[nodiscard]] bool has_meaning() const;
  /// What forces do beyond the modes.
  [[nodiscard]] Eigen::MatrixXcd beyond(const Eigen::MatrixXcd& forces) const;

 private:
  const RingHarmonic* h_;
  std::unique_ptr<SparseFactor> factor_ = std::make_unique<SparseFactor>();  // it cannot be moved
  Eigen::MatrixXcd modes_;
};

/// That of a harmonic; where it has no meaning, that without a rate.
[[nodiscard]] StandingAnswer standing_answer(const SolidRing& ring, const SparseComplex& stiffness,
                                             const RingHarmonic* h, int k, double spin,
                                             bool& made_static, double inertia = 1.0);

/// Z_k of a viscous ring and of its modes, with K(k) g in place of K(k).
class ViscousAnswer {
 public:
  /// @param modulus g at the rate ks
  ViscousAnswer(const SolidRing& ring, const SparseComplex& stiffness, const RingHarmonic* h, int k,
                double spin, const std::complex<double>& modulus);
  /// What forces do beyond the modes, at the rate and at its opposite.
  [[nodiscard]] Eigen::MatrixXcd ahead(const Eigen::MatrixXcd& forces) const;
  [[nodiscard]] Eigen::MatrixXcd back(const Eigen::MatrixXcd& forces) const;

 private:
  const RingHarmonic* h_;
  std::unique_ptr<Eigen::SparseLU<SparseComplex>> factor_ =
      std::make_unique<Eigen::SparseLU<SparseComplex>>();
  Eigen::MatrixXcd modes_;
};

}  // namespace rondo::rom
