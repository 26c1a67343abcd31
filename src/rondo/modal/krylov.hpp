// SPDX-License-Identifier: BSD-3-Clause
/// @file  Extreme eigenvalues of an operator that is Hermitian or skew in an inner product, by
/// block Krylov spaces with full orthogonalisation (docs/theory.md, 8.3).
#pragma once
#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <functional>

namespace rondo::modal {

/// T, Hermitian in the inner product xᴴ P y, or skew: then i T is Hermitian, and its eigenvalues
/// are meant.
template <class Scalar>
struct Operator {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  Eigen::Index size = 0;  ///< of a vector
  /// Dimension of the space of eigenvectors sought: `size` less those that `apply` takes out.
  /// It may be less, as where T is singular: the space ends where T gives nothing new.
  Eigen::Index rank = 0;
  bool skew = false;
  std::function<Vector(const Vector&)> apply;   ///< T x
  std::function<Vector(const Vector&)> metric;  ///< P x
};

/// Approximate eigenvalues μ, descending, of the space as it is.
struct Ritz {
  Eigen::VectorXd value;
  Eigen::VectorXd residual;  ///< ‖T x - μ x‖ in the norm of P, of each
  Eigen::MatrixXcd weights;  ///< columns: x in the basis
};

/// A space that grows by T times what was added last. Random numbers are the same in each run.
template <class Scalar>
class Krylov {
 public:
  using Vector = typename Operator<Scalar>::Vector;
  using Columns = typename Operator<Scalar>::Columns;

  explicit Krylov(const Operator<Scalar>& op) : op_(op), rank_(op.rank) {}

  /// One more block; a new direction where the space does not grow by itself any more.
  void grow();
  /// A random direction: what the space cannot reach, such as the second vector of a double
  /// eigenvalue, it will reach after that.
  void widen();
  /// Nothing is outside but what T takes to 0: the Ritz values are the eigenvalues.
  [[nodiscard]] bool complete() const noexcept { return done_ >= rank_; }
  [[nodiscard]] Eigen::Index dimension() const noexcept { return done_; }

  [[nodiscard]] Ritz ritz() const;
  /// x of column `column` of `ritz.weights`.
  [[nodiscard]] Eigen::VectorXcd vector(const Ritz& ritz, Eigen::Index column) const;

 private:
  double orthogonalise(Vector& x, Eigen::Index first, Eigen::Index from);
  bool add(Vector x, Eigen::Index from);
  void reserve(Eigen::Index columns);
  Vector random();

  const Operator<Scalar>& op_;
  Columns basis_;      ///< P-orthonormal; the first done_ columns have been multiplied by T
  Columns projected_;  ///< column j: basisᴴ P T (column j of the basis), j < done_
  Eigen::Index rank_;  ///< of what T gives, as far as it is known
  Eigen::Index done_ = 0, all_ = 0;
  std::uint64_t seed_ = 1;
};

extern template class Krylov<double>;
extern template class Krylov<std::complex<double>>;

/// Residual over |μ| at which an eigenvalue counts as found; its own error is the square of it.
inline constexpr double krylov_tolerance = 1e-10;

/// Grows the space until the `above` largest μ are found to the tolerance and > limit, and the
/// `below` lowest < -limit; at the latest until it is complete.
template <class Scalar>
Ritz eigenvalues_beyond(Krylov<Scalar>& space, double limit, Eigen::Index above,
                        Eigen::Index below);

extern template Ritz eigenvalues_beyond(Krylov<double>&, double, Eigen::Index, Eigen::Index);
extern template Ritz eigenvalues_beyond(Krylov<std::complex<double>>&, double, Eigen::Index,
                                        Eigen::Index);

}  // namespace rondo::modal
