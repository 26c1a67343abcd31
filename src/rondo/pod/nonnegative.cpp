// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/nonnegative.hpp"

#include "rondo/core/contract.hpp"

namespace rondo::pod {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What is left of A below this share of ‖A‖ is round-off.
constexpr double nothing = 1e-12;

/// Of the coefficients alone, for each pattern of the start.
constexpr int start_sweeps = 100;

/// Each row of H in turn: the best with W and the other rows fixed. A pattern that is zero has a
/// row of zeros.
void sweep_rows(const MatrixXd& a, const MatrixXd& w, MatrixXd& h, int sweeps) {
  const MatrixXd gram = w.transpose() * w, product = w.transpose() * a;
  for (int s = 0; s < sweeps; ++s)
    for (Index i = 0; i < h.rows(); ++i) {
      if (gram(i, i) == 0.0) {
        h.row(i).setZero();
        continue;
      }
      const Eigen::RowVectorXd left = product.row(i) - gram.row(i) * h;
      h.row(i) = (h.row(i) + left / gram(i, i)).cwiseMax(0.0);
    }
}

/// Each column of W likewise. One whose row is zero has no part in the product: it stays.
void sweep_columns(const MatrixXd& a, const MatrixXd& h, MatrixXd& w) {
  const MatrixXd gram = h * h.transpose(), product = a * h.transpose();
  for (Index i = 0; i < w.cols(); ++i) {
    if (gram(i, i) == 0.0) continue;
    const VectorXd left = product.col(i) - w * gram.col(i);
    w.col(i) = (w.col(i) + left / gram(i, i)).cwiseMax(0.0);
  }
}

/// Columns of A one by one: the one that those so far hold worst.
void start(const MatrixXd& a, Index k, double held, MatrixXd& w, MatrixXd& h) {
  w.resize(a.rows(), 0);
  h.resize(0, a.cols());
  const double norm = a.norm();
  std::vector<char> taken(static_cast<std::size_t>(a.cols()), 0);
  while (w.cols() < k) {
    VectorXd left = (a - w * h).colwise().norm();
    for (Index j = 0; j < a.cols(); ++j)
      if (taken[static_cast<std::size_t>(j)]) left[j] = 0.0;
    Index worst = 0;
    if (a.size() == 0 || left.maxCoeff(&worst) <= held * norm) return;
    taken[static_cast<std::size_t>(worst)] = 1;
    const Index i = w.cols();
    w.conservativeResize(Eigen::NoChange, i + 1);
    h.conservativeResize(i + 1, Eigen::NoChange);
    w.col(i) = a.col(worst).normalized();
    h.row(i).setZero();
    h.col(worst).setZero();
    h(i, worst) = a.col(worst).norm();
    sweep_rows(a, w, h, start_sweeps);
  }
}

/// A pattern that has lost its part begins anew as what is missing of the column that is held
/// worst. Its row is zero: the product stays what it is.
void restart_dead(const MatrixXd& a, MatrixXd& w, const MatrixXd& h) {
  MatrixXd missing;
  for (Index i = 0; i < w.cols(); ++i) {
    if (w.col(i).maxCoeff() > 0.0 && h.row(i).maxCoeff() > 0.0) continue;
    if (missing.size() == 0) missing = (a - w * h).cwiseMax(0.0);
    Index worst = 0;
    if (missing.colwise().norm().maxCoeff(&worst) <= nothing * a.norm()) return;
    w.col(i) = missing.col(worst);
    missing.col(worst).setZero();
  }
}

/// Patterns of sum 1; the dead ones left out.
void finish(NonnegativeFactors& f) {
  Index kept = 0;
  for (Index i = 0; i < f.w.cols(); ++i) {
    const double sum = f.w.col(i).sum();
    if (sum == 0.0 || f.h.row(i).maxCoeff() == 0.0) continue;
    f.w.col(kept) = (f.w.col(i) / sum).eval();
    f.h.row(kept) = (f.h.row(i) * sum).eval();
    ++kept;
  }
  f.w.conservativeResize(Eigen::NoChange, kept);
  f.h.conservativeResize(kept, Eigen::NoChange);
}

}  // namespace

NonnegativeFactors factor_nonnegative(const MatrixXd& a, Index k, const NonnegativeLimits& limits) {
  RONDO_DEMAND(k >= 1 && a.allFinite() && (a.array() >= 0.0).all(), k);
  NonnegativeFactors f;
  start(a, k, limits.held, f.w, f.h);
  const double norm = a.norm();
  const auto residual = [&] { return norm > 0.0 ? (a - f.w * f.h).norm() / norm : 0.0; };
  f.residuals.push_back(residual());
  while (f.sweeps() < limits.most_sweeps && f.residual() > nothing) {
    const double before = f.residual();
    sweep_columns(a, f.h, f.w);
    sweep_rows(a, f.w, f.h, 1);
    f.residuals.push_back(residual());
    if (before - f.residual() < limits.change * before) break;
    restart_dead(a, f.w, f.h);
  }
  finish(f);
  return f;
}

}  // namespace rondo::pod
