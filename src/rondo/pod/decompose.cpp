// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/decompose.hpp"

#include <algorithm>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/pod/methods.hpp"
#include "rondo/pod/spectrum.hpp"
#include "rondo/pod/svd.hpp"

namespace rondo::pod {

double round_off(Index rows, Index columns, double largest) {
  return static_cast<double>(std::max(rows, columns)) * std::numeric_limits<double>::epsilon() *
         largest;
}

Index rank_and_choose(Decomposition& d, Index asked, Index most) {
  const double largest = d.sigma.size() > 0 ? d.sigma[0] : 0.0;
  const double least = round_off(d.modes.rows(), d.temporal.rows(), largest);
  d.rank = (d.sigma.array() > least).count();
  Index kept = asked;
  if (asked < 0) {
    kept = modes_for(spectrum(d), default_discarded);
    if (kept < 0) kept = d.rank;
    kept = std::max<Index>(kept, 1);
  }
  return std::min({kept, d.rank, most});
}

void fix_signs(Decomposition& d) {
  for (Index i = 0; i < d.modes.cols(); ++i) {
    Index at = 0;
    d.modes.col(i).cwiseAbs().maxCoeff(&at);
    if (d.modes(at, i) >= 0.0) continue;
    d.modes.col(i) = -d.modes.col(i);
    d.temporal.col(i) = -d.temporal.col(i);
  }
}

namespace {

Eigen::MatrixXd read_all(SnapshotMatrix& source, Progress& progress) {
  Eigen::MatrixXd a(source.rows(), source.columns());
  const Index block = std::max<Index>(1, (Index{1} << 22) / source.rows());
  for (Index first = 0; first < a.cols(); first += block) {
    auto part = a.middleCols(first, std::min(block, a.cols() - first));
    source.read_columns(first, part);
    progress.add(part.size());
  }
  return a;
}

/// A = Q R, R = U' Σ Vᵀ, U = Q U', computed only for the modes that are kept.
void tall(Eigen::MatrixXd& a, Index asked, Decomposition& d) {
  const Eigen::VectorXd factors = factor_qr(a);
  Eigen::MatrixXd r = upper(a);
  Svd small = thin_svd(r);
  d.sigma = std::move(small.sigma);
  d.temporal = std::move(small.v);
  d.modes.resize(a.rows(), 0);
  const Index kept = rank_and_choose(d, asked, d.sigma.size());
  d.modes.setZero(a.rows(), kept);
  d.modes.topRows(a.cols()) = small.u.leftCols(kept);
  apply_q(a, factors, d.modes);
}

/// A = L Q, L = U Σ V'ᵀ, V = Qᵀ V'.
void wide(Eigen::MatrixXd& a, Index asked, Decomposition& d) {
  const Eigen::VectorXd factors = factor_lq(a);
  Eigen::MatrixXd l = a.leftCols(a.rows()).triangularView<Eigen::Lower>();
  Svd small = thin_svd(l);
  d.sigma = std::move(small.sigma);
  d.temporal.setZero(a.cols(), a.rows());
  d.temporal.topRows(a.rows()) = small.v;
  apply_lq_transposed(a, factors, d.temporal);
  d.modes.resize(a.rows(), 0);
  const Index kept = rank_and_choose(d, asked, d.sigma.size());
  d.modes = small.u.leftCols(kept);
}

}  // namespace

Decomposition direct(SnapshotMatrix& source, const DecomposeOptions& options) {
  Decomposition d;
  d.method = Method::direct;
  Progress progress(source, options, 2);  // half for reading, half for the decomposition
  Eigen::MatrixXd a = read_all(source, progress);
  d.energy = a.squaredNorm();
  if (a.rows() >= a.cols())
    tall(a, options.modes, d);
  else
    wide(a, options.modes, d);
  progress.finish();
  return d;
}

Decomposition decompose(SnapshotMatrix& snapshots, const DecomposeOptions& options) {
  const DecomposePlan p =
      plan(snapshots.rows(), snapshots.columns(), snapshots.row_grain(), options);
  const OneBlasThread one_thread;
  Decomposition d = p.method == Method::direct ? direct(snapshots, options)
                    : p.method == Method::tsqr ? tsqr(snapshots, options, p)
                                               : incremental(snapshots, options, p);
  RONDO_DEMAND(d.energy >= 0.0 && d.energy <= std::numeric_limits<double>::max(), d.energy);
  fix_signs(d);
  return d;
}

}  // namespace rondo::pod
