// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/complex_lu.hpp"

#include <cblas.h>
#define LAPACK_COMPLEX_CUSTOM  // else C's own, which C++ does not know
#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <lapacke.h>

#include <limits>
#include <utility>

namespace rondo::statics {
namespace {

constexpr std::complex<double> no_number{std::numeric_limits<double>::quiet_NaN(), 0.0};

int rows_of(const Eigen::MatrixXcd& m) {
  return static_cast<int>(m.rows());
}

}  // namespace

using SolidLu = ComplexLu<3, Eigen::Dynamic>;

SolidLu::ComplexLu(Block block)
    : factors_(std::move(block)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  const int n = rows_of(factors_);
  const lapack_int bad = LAPACKE_zgetrf(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
  if (bad != 0) factors_.setConstant(no_number);
}

SolidLu::Block SolidLu::solved(Block right) const {
  const int n = rows_of(factors_);
  // It looks for NaN in either, and then does nothing.
  const lapack_int bad = LAPACKE_zgetrs(LAPACK_COL_MAJOR, 'N', n, static_cast<int>(right.cols()),
                                        factors_.data(), n, pivots_.data(), right.data(), n);
  if (bad != 0) right.setConstant(no_number);
  return right;
}

SolidLu::Block SolidLu::inverse() const {
  Block inverse = factors_;
  const int n = rows_of(factors_);
  if (LAPACKE_zgetri(LAPACK_COL_MAJOR, n, inverse.data(), n, pivots_.data()) != 0)
    inverse.setConstant(no_number);
  return inverse;
}

/// Eigen's own is for any processor, and slower.
void SolidLu::add_product(const Block& a, const Block& b, Block& c) {
  const std::complex<double> one{1.0, 0.0};
  const auto m = rows_of(a), n = static_cast<int>(b.cols()), k = rows_of(b);
  cblas_zgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, &one, a.data(), m, b.data(), k,
              &one, c.data(), m);
}

}  // namespace rondo::statics
