// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/krylov.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"

namespace rondo::modal {
namespace {

using Eigen::Index;

/// Columns of a block; two are enough to find a double eigenvalue.
constexpr Index block = 2;
/// Smallest relative length that orthogonalisation may leave of a vector; less is round-off.
constexpr double dependent = 1e-12;

double real(double x) {
  return x;
}
double real(std::complex<double> x) {
  return x.real();
}

}  // namespace

template <class Scalar>
void Krylov<Scalar>::reserve(Index columns) {
  if (columns <= basis_.cols()) return;
  const Index capacity = std::min(std::max(columns, 2 * basis_.cols()), rank_ + block);
  basis_.conservativeResize(op_.size, std::max(columns, capacity));
  const Index before = projected_.cols();
  projected_.conservativeResize(basis_.cols(), basis_.cols());
  projected_.bottomRows(basis_.cols() - before).setZero();
  projected_.rightCols(basis_.cols() - before).setZero();
}

/// Random number in [-1, 1) from a counter and the finaliser of a hash (splitmix64).
template <class Scalar>
auto Krylov<Scalar>::random() -> Vector {
  Vector x(op_.size);
  for (Index i = 0; i < x.size(); ++i) {
    std::uint64_t z = seed_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    x[i] = static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-52 - 1.0;
  }
  return x;
}

/// Removes from x its components along the basis from column `first` on and adds them to column
/// `from` of the projected operator (-1: nowhere). Returns the norm of x afterwards.
template <class Scalar>
double Krylov<Scalar>::orthogonalise(Vector& x, Index first, Index from) {
  const auto columns = basis_.middleCols(first, all_ - first);
  const Vector parts = columns.adjoint() * op_.metric(x);
  x.noalias() -= columns * parts;
  if (from >= 0) projected_.col(from).segment(first, all_ - first) += parts;
  return std::sqrt(std::max(0.0, real(x.dot(op_.metric(x)))));
}

/// Makes x P-orthonormal and adds it to the basis; its components along the basis are added to
/// column `from` of the projected operator (-1: nowhere). False if nothing new is left of x.
template <class Scalar>
bool Krylov<Scalar>::add(Vector x, Index from) {
  const double start = std::sqrt(std::max(0.0, real(x.dot(op_.metric(x)))));
  // Except for round-off and vectors added by widen(), T x lies in the last blocks. One pass over
  // the whole basis is then enough, unless it removes much of x.
  double before = orthogonalise(x, std::max<Index>(0, all_ - 3 * block), from);
  double norm = orthogonalise(x, 0, from);
  for (int pass = 0; pass < 3 && norm < 0.7 * before; ++pass) {
    before = norm;
    norm = orthogonalise(x, 0, from);
  }
  if (!(norm > dependent * start) || all_ >= rank_) return false;
  reserve(all_ + 1);
  basis_.col(all_) = x / norm;
  if (from >= 0) projected_(all_, from) = norm;
  ++all_;
  return true;
}

template <class Scalar>
void Krylov<Scalar>::widen() {
  if (all_ >= rank_) return;
  reserve(all_ + 1);
  for (int tries = 0; tries < 10; ++tries)
    if (add(op_.apply(random()), -1)) return;  // T x contains nothing that `apply` removes
  rank_ = all_;
}

template <class Scalar>
void Krylov<Scalar>::grow() {
  if (all_ == 0)
    for (Index i = 0; i < block; ++i) widen();
  if (done_ == all_) widen();
  const Index end = all_;
  for (; done_ < end; ++done_) static_cast<void>(add(op_.apply(basis_.col(done_)), done_));
}

template <class Scalar>
Ritz Krylov<Scalar>::ritz() const {
  if (done_ == 0) return {};  // T is 0
  Eigen::MatrixXcd h = projected_.topLeftCorner(done_, done_).template cast<std::complex<double>>();
  if (op_.skew) h *= std::complex<double>(0.0, 1.0);
  const Eigen::MatrixXcd hermitian = 0.5 * (h + h.adjoint());
  const Axes<Eigen::MatrixXcd> axes = axes_of(hermitian);
  Ritz out;
  out.value = axes.values.reverse();
  out.weights = axes.vectors.rowwise().reverse();
  const Eigen::MatrixXcd rest =
      projected_.block(done_, 0, all_ - done_, done_).template cast<std::complex<double>>();
  out.residual = (rest * out.weights).colwise().norm().transpose();
  return out;
}

template <class Scalar>
Eigen::VectorXcd Krylov<Scalar>::vector(const Ritz& ritz, Index column) const {
  const auto columns = basis_.leftCols(ritz.weights.rows());
  if constexpr (std::is_same_v<Scalar, double>) {
    Eigen::VectorXcd x(columns.rows());
    x.real() = columns * ritz.weights.col(column).real();
    x.imag() = columns * ritz.weights.col(column).imag();
    return x;
  } else {
    return columns * ritz.weights.col(column);
  }
}

template class Krylov<double>;
template class Krylov<std::complex<double>>;

namespace {

/// Whether the first `n` values from one end are beyond the limit and have converged.
bool found(const Ritz& r, double limit, Index n, bool above) {
  const Index m = r.value.size();
  if (n > m) return false;
  for (Index i = 0; i < n; ++i) {
    const Index k = above ? i : m - 1 - i;
    const double value = above ? r.value[k] : -r.value[k];
    if (!(value > limit) || r.residual[k] > krylov_tolerance * value) return false;
  }
  return true;
}

}  // namespace

template <class Scalar>
Ritz eigenvalues_beyond(Krylov<Scalar>& space, double limit, Index above, Index below) {
  double next = 0.0, widened = static_cast<double>(2 * (above + below) + 40);
  while (true) {
    if (!space.complete()) space.grow();
    const auto m = static_cast<double>(space.dimension());
    if (m < next && !space.complete()) continue;
    next = 1.1 * m;
    Ritz r = space.ritz();
    const bool all = found(r, limit, above, true) && found(r, limit, below, false);
    if (all || space.complete()) return r;
    if (m < 2.0 * widened) continue;
    space.widen();  // it takes longer than expected: some values may be multiple
    widened = m;
  }
}

template Ritz eigenvalues_beyond(Krylov<double>&, double, Index, Index);
template Ritz eigenvalues_beyond(Krylov<std::complex<double>>&, double, Index, Index);

}  // namespace rondo::modal
