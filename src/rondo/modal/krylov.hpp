// SPDX-License-Identifier: BSD-3-Clause
/// @file  Extreme eigenvalues of an operator that is Hermitian or skew-Hermitian in an inner
/// product, by block Krylov spaces with full orthogonalisation (docs/theory.md, 8.3).
#pragma once
#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <functional>

namespace rondo::modal {

/// T, either Hermitian in the inner product xᴴ P y, or skew: i T is then Hermitian, and the
/// eigenvalues are those of i T.
template <class Scalar>
struct Operator {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  Eigen::Index size = 0;  ///< of a vector
  /// Dimension of the space of the eigenvectors: `size` minus that of the vectors that `apply`
  /// removes. It may be less, e.g. if T is singular: the space ends when T gives nothing new.
  Eigen::Index rank = 0;
  bool skew = false;
  std::function<Vector(const Vector&)> apply;   ///< T x
  std::function<Vector(const Vector&)> metric;  ///< P x
};

/// Approximate eigenvalues μ, descending, from the present space.
struct Ritz {
  Eigen::VectorXd value;
  Eigen::VectorXd residual;  ///< ‖T x - μ x‖ in the norm of P, for each μ
  Eigen::MatrixXcd weights;  ///< columns: coefficients of x in the basis
};

/// A space that grows by T times its last block. Random numbers are the same in each run.
template <class Scalar>
class Krylov {
 public:
  using Vector = typename Operator<Scalar>::Vector;
  using Columns = typename Operator<Scalar>::Columns;

  explicit Krylov(const Operator<Scalar>& op) : op_(op), rank_(op.rank) {}

  /// Adds a block; it is a new random direction if the space no longer grows by itself.
  void grow();
  /// Adds a random direction, so that the space reaches vectors that it could not reach before,
  /// such as the second vector of a double eigenvalue.
  void widen();
  /// Whether T maps everything outside to 0: the Ritz values are then the eigenvalues.
  [[nodiscard]] bool complete() const noexcept { return done_ >= rank_; }
  [[nodiscard]] Eigen::Index dimension() const noexcept { return done_; }

  [[nodiscard]] Ritz ritz() const;
  /// The vector x of column `column` of `ritz.weights`.
  [[nodiscard]] Eigen::VectorXcd vector(const Ritz& ritz, Eigen::Index column) const;

 private:
  double orthogonalise(Vector& x, Eigen::Index first, Eigen::Index from);
  bool add(Vector x, Eigen::Index from);
  void reserve(Eigen::Index columns);
  Vector random();

  const Operator<Scalar>& op_;
  Columns basis_;      ///< P-orthonormal; the first done_ columns have been multiplied by T
  Columns projected_;  ///< column j: basisᴴ P T (column j of the basis), j < done_
  Eigen::Index rank_;  ///< rank of T as far as it is known
  Eigen::Index done_ = 0, all_ = 0;
  std::uint64_t seed_ = 1;
};

extern template class Krylov<double>;
extern template class Krylov<std::complex<double>>;

/// Largest residual / |μ| of an eigenvalue that counts as found; its own error is the square of it.
inline constexpr double krylov_tolerance = 1e-10;

/// Grows the space until the `above` largest μ > limit and the `below` lowest μ < -limit are found
/// to the tolerance, or the space is complete.
template <class Scalar>
Ritz eigenvalues_beyond(Krylov<Scalar>& space, double limit, Eigen::Index above,
                        Eigen::Index below);

extern template Ritz eigenvalues_beyond(Krylov<double>&, double, Eigen::Index, Eigen::Index);
extern template Ritz eigenvalues_beyond(Krylov<std::complex<double>>&, double, Eigen::Index,
                                        Eigen::Index);

}  // namespace rondo::modal
