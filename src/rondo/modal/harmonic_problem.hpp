// SPDX-License-Identifier: BSD-3-Clause
/// @file  One harmonic of a body of equal sectors in constant spin (docs/theory.md, 8.2): with
/// w = M^½ φ of one sector and the Hermitian 2iJ,
///   (A' - ω² + 2iωsJ) w = 0,    A' = A(n) - s² P                                          (8.2)
/// where ω may have both signs: w e^{i(nϑ + ωt)} travels clockwise if ω > 0.
#pragma once
#include <Eigen/SparseCholesky>
#include <complex>
#include <vector>

#include "rondo/fem/harmonics.hpp"
#include "rondo/modal/krylov.hpp"
#include "rondo/modal/modes.hpp"

namespace rondo::modal {

/// A root of (8.2) and its normalised vector.
struct HarmonicRoot {
  double omega = 0.0;  ///< has both signs; >= 0 at rest                        [rad/s]
  Eigen::VectorXcd w;  ///< (D n_local), polar components, ‖w‖ = 1
};

/// Numbers of roots in (0, σ) and in (-σ, 0); at rest both are the same.
struct RootCounts {
  int positive = 0, negative = 0;
};

/// 1 for an unknown in the plane of the body, 0 for an axial one.
template <int D>
[[nodiscard]] constexpr double in_plane(Eigen::Index unknown) noexcept {
  return unknown % D < 2 ? 1.0 : 0.0;
}

/// 2iJ w: (x, y) of each node becomes 2i (-y, x), and an axial component 0.
template <int D>
Eigen::VectorXcd gyroscopic(const Eigen::VectorXcd& w);

template <int D>
class HarmonicProblem {
 public:
  using Complex = std::complex<double>;
  using Matrix = fem::Harmonics::Matrix;

  HarmonicProblem(const CyclicBody<D>& body, double spin);

  /// Number of harmonics: N/2 + 1, rounded down.
  [[nodiscard]] int n_harmonics() const noexcept { return harmonics_.count(); }
  /// Size of the matrices: D n_local.
  [[nodiscard]] int size() const noexcept { return static_cast<int>(harmonics_.size()); }
  /// Whether all numbers are finite, so that the problem can be solved.
  [[nodiscard]] bool finite();
  /// Selects harmonic `n` for all following calls.
  void choose(int n);
  /// Whether w and its conjugate, of harmonic N - n, are two different motions: 0 < n < N/2.
  [[nodiscard]] bool has_partner() const noexcept;
  /// Unit vector of a rigid-body motion of a free body, which the functions below exclude: the
  /// rotation in harmonic 0, the translations in harmonic 1; else empty.
  [[nodiscard]] const Eigen::VectorXcd& rigid() const noexcept { return rigid_; }

  /// Number of negative eigenvalues of A'.
  int unstable() { return negative(0.0); }
  /// Numbers of roots with |ω| < σ. @pre unstable() is 0, σ > 0
  RootCounts count_below(double sigma);
  /// All roots with |ω| < σ. @pre unstable() is 0
  std::vector<HarmonicRoot> roots_below(double sigma, RootCounts counts);
  /// A σ below which there are at least `count` roots, or all.
  double sigma_with(int count);
  /// Largest dimension of the Krylov spaces so far.
  [[nodiscard]] int dimension() const noexcept { return dimension_; }

  /// A' of harmonic 0 as a dense matrix, real.
  Eigen::MatrixXd dense_rotational();

 private:
  int negative(double omega);
  void factorise(double shift);
  [[nodiscard]] Operator<Complex> at_rest(double shift);
  [[nodiscard]] Operator<Complex> in_spin();
  void take_rigid_out(Eigen::Ref<Eigen::VectorXcd> w) const;

  [[nodiscard]] const Matrix& spun(double shift);

  const CyclicBody<D>& body_;
  double spin_;
  fem::Harmonics harmonics_;
  int n_ = 0;
  int dimension_ = 0;
  Eigen::VectorXcd rigid_;
  Matrix lower_;  ///< of A', in the form that the operators use
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> factor_;
};

}  // namespace rondo::modal
