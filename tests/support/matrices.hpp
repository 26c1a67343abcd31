// SPDX-License-Identifier: BSD-3-Clause
/// @file  Matrices of known spectrum, and a source that checks how it is read.
#pragma once
#include <Eigen/Dense>
#include <Eigen/QR>
#include <algorithm>
#include <random>
#include <stdexcept>
#include <utility>

#include "rondo/pod/decompose.hpp"

namespace rondo::pod::test {

inline Eigen::MatrixXd random_matrix(Index rows, Index columns, unsigned seed = 1) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(engine); });
}

inline Eigen::MatrixXd random_orthonormal(Index rows, Index columns, unsigned seed) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(random_matrix(rows, columns, seed));
  return qr.householderQ() * Eigen::MatrixXd::Identity(rows, columns);
}

/// U diag(sigma) Vᵀ.
inline Eigen::MatrixXd with_spectrum(Index rows, Index columns, const Eigen::VectorXd& sigma) {
  return random_orthonormal(rows, sigma.size(), 2) * sigma.asDiagonal() *
         random_orthonormal(columns, sigma.size(), 3).transpose();
}

/// 1, 10^{-last/(n-1)}, ..., 10^{-last}.
inline Eigen::VectorXd falling(Index n, double last) {
  Eigen::VectorXd sigma(n);
  for (Index i = 0; i < n; ++i)
    sigma[i] = std::pow(10.0, -last * static_cast<double>(i) / static_cast<double>(n - 1));
  return sigma;
}

/// Fails if a block of rows does not start at a multiple of the grain, or a read is out of range.
class WatchedSnapshots final : public SnapshotMatrix {
 public:
  explicit WatchedSnapshots(Eigen::MatrixXd values, Index grain = 1)
      : values_(std::move(values)), grain_(grain) {}
  [[nodiscard]] Index rows() const noexcept override { return values_.rows(); }
  [[nodiscard]] Index columns() const noexcept override { return values_.cols(); }
  [[nodiscard]] Index row_grain() const noexcept override { return grain_; }
  void read_columns(Index first, Eigen::Ref<Eigen::MatrixXd> out) override {
    see(out.size());
    if (out.rows() != rows() || first < 0 || out.cols() < 1 || first + out.cols() > columns())
      throw std::out_of_range("columns");
    out = values_.middleCols(first, out.cols());
  }
  void read_rows(Index first, Eigen::Ref<Eigen::MatrixXd> out) override {
    see(out.size());
    if (out.cols() != columns() || first < 0 || out.rows() < 1 || first + out.rows() > rows())
      throw std::out_of_range("rows");
    const Index last = first + out.rows();
    if (first % grain_ != 0 || (last % grain_ != 0 && last != rows()))
      throw std::out_of_range("grain");
    out = values_.middleRows(first, out.rows());
  }
  [[nodiscard]] const Eigen::MatrixXd& values() const { return values_; }
  [[nodiscard]] Index largest_block() const { return largest_; }  ///< in one read
  [[nodiscard]] int reads() const { return reads_; }

 private:
  void see(Index numbers) {
    largest_ = std::max(largest_, numbers);
    ++reads_;
  }
  Eigen::MatrixXd values_;
  Index grain_, largest_ = 0;
  int reads_ = 0;
};

inline Decomposition decompose_dense(const Eigen::MatrixXd& a, Method method, Index modes = -1) {
  DenseSnapshots source(a);
  DecomposeOptions options;
  options.method = method;
  options.modes = modes;
  return decompose(source, options);
}

/// max |aᵀa - I|
inline double off_orthonormal(const Eigen::MatrixXd& a) {
  if (a.cols() == 0) return 0.0;
  return (a.transpose() * a - Eigen::MatrixXd::Identity(a.cols(), a.cols())).cwiseAbs().maxCoeff();
}

inline double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace rondo::pod::test
