// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/svd.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <limits>

#include "rondo/core/contract.hpp"

namespace rondo::pod {
namespace {

int length(Index n) {
  RONDO_DEMAND(n >= 0 && n <= std::numeric_limits<int>::max(), n);
  return static_cast<int>(n);
}

/// Column stride: LAPACK requires at least 1, even if there are no rows.
template <class Matrix>
int stride(const Matrix& m) {
  return std::max({1, length(m.outerStride()), length(m.rows())});
}

void product(CBLAS_TRANSPOSE left, const In& a, const In& b, Out& c, double factor, double scale) {
  const Index inner = left == CblasTrans ? a.rows() : a.cols();
  const Index rows = left == CblasTrans ? a.cols() : a.rows();
  RONDO_DEMAND(c.rows() == rows && c.cols() == b.cols() && b.rows() == inner, c.rows(), rows,
               c.cols(), b.cols(), b.rows(), inner);
  if (c.size() == 0) return;
  cblas_dgemm(CblasColMajor, left, CblasNoTrans, length(rows), length(c.cols()), length(inner),
              factor, a.data(), stride(a), b.data(), stride(b), scale, c.data(), stride(c));
}

}  // namespace

void multiply(const In& a, const In& b, Out c, double factor, double scale) {
  product(CblasNoTrans, a, b, c, factor, scale);
}

void multiply_transposed(const In& a, const In& b, Out c) {
  product(CblasTrans, a, b, c, 1.0, 0.0);
}

void multiply_in_place(Out m, const In& t) {
  constexpr Index most = 512;  // rows per step: the copy stays in the cache
  RONDO_DEMAND(t.rows() == m.cols() && t.cols() <= m.cols(), t.rows(), t.cols(), m.cols());
  Eigen::MatrixXd part(std::min(most, m.rows()), t.cols());
  for (Index first = 0; first < m.rows(); first += most) {
    const Index n = std::min(most, m.rows() - first);
    multiply(m.middleRows(first, n), t, part.topRows(n));
    m.block(first, 0, n, t.cols()) = part.topRows(n);
  }
}

Eigen::VectorXd factor_qr(Out a) {
  Eigen::VectorXd factors(std::min(a.rows(), a.cols()));
  if (factors.size() == 0) return factors;
  const int info = LAPACKE_dgeqrf(LAPACK_COL_MAJOR, length(a.rows()), length(a.cols()), a.data(),
                                  stride(a), factors.data());
  RONDO_DEMAND(info == 0, info, a.rows(), a.cols());
  return factors;
}

Eigen::MatrixXd upper(const In& factored) {
  const Index k = std::min(factored.rows(), factored.cols());
  return factored.topRows(k).triangularView<Eigen::Upper>();
}

void form_q(Out factored, const Eigen::VectorXd& factors) {
  if (factors.size() == 0) return;
  const int k = length(factors.size());
  const int info = LAPACKE_dorgqr(LAPACK_COL_MAJOR, length(factored.rows()), k, k, factored.data(),
                                  stride(factored), factors.data());
  RONDO_DEMAND(info == 0, info, factored.rows(), k);
}

void apply_q(const In& factored, const Eigen::VectorXd& factors, Out c) {
  if (c.size() == 0) return;
  const int info = LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'N', length(c.rows()), length(c.cols()),
                                  length(factors.size()), factored.data(), stride(factored),
                                  factors.data(), c.data(), stride(c));
  RONDO_DEMAND(info == 0, info, c.rows(), c.cols());
}

Eigen::VectorXd factor_lq(Out a) {
  Eigen::VectorXd factors(std::min(a.rows(), a.cols()));
  const int info = LAPACKE_dgelqf(LAPACK_COL_MAJOR, length(a.rows()), length(a.cols()), a.data(),
                                  stride(a), factors.data());
  RONDO_DEMAND(info == 0, info, a.rows(), a.cols());
  return factors;
}

void apply_lq_transposed(const In& factored, const Eigen::VectorXd& factors, Out c) {
  if (c.size() == 0) return;
  const int info = LAPACKE_dormlq(LAPACK_COL_MAJOR, 'L', 'T', length(c.rows()), length(c.cols()),
                                  length(factors.size()), factored.data(), stride(factored),
                                  factors.data(), c.data(), stride(c));
  RONDO_DEMAND(info == 0, info, c.rows(), c.cols());
}

void orthonormalise(Out a) {
  RONDO_DEMAND(a.rows() >= a.cols(), a.rows(), a.cols());
  const Eigen::VectorXd factors = factor_qr(a);
  const Eigen::VectorXd diagonal = a.diagonal();
  form_q(a, factors);
  for (Index i = 0; i < a.cols(); ++i)
    if (diagonal[i] < 0.0) a.col(i) = -a.col(i);
}

double orthonormality(const In& a) {
  if (a.cols() == 0) return 0.0;
  Eigen::MatrixXd gram(a.cols(), a.cols());
  multiply_transposed(a, a, gram);
  gram.diagonal().array() -= 1.0;
  return gram.cwiseAbs().maxCoeff();
}

StackedQr::StackedQr(Index columns)
    : r_(Eigen::MatrixXd::Zero(columns, columns)), t_(std::min<Index>(32, columns), columns) {}

void StackedQr::add(Out rows) {
  // Equal parts with about as many rows as fit into the cache.
  const Index parts = std::max<Index>(1, rows.rows() / 2048);
  const Index most = (rows.rows() + parts - 1) / parts;
  const int n = length(r_.cols()), panel = length(t_.rows());
  RONDO_DEMAND(rows.cols() == r_.cols(), rows.cols(), n);
  for (Index first = 0; first < rows.rows(); first += most) {
    const int count = length(std::min(most, rows.rows() - first));
    const int info = LAPACKE_dtpqrt(LAPACK_COL_MAJOR, count, n, 0, panel, r_.data(), n,
                                    rows.data() + first, stride(rows), t_.data(), panel);
    RONDO_DEMAND(info == 0, info, count, n);
  }
}

}  // namespace rondo::pod
