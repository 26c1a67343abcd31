// SPDX-License-Identifier: BSD-3-Clause
/// QR of blocks of rows, each added to the same R (docs/theory.md, 7.2): Σ and V are those of R. U
/// requires reading the snapshots a second time.
#include <algorithm>

#include "rondo/pod/methods.hpp"
#include "rondo/pod/svd.hpp"

namespace rondo::pod {
namespace {

Eigen::MatrixXd triangle_by_rows(SnapshotMatrix& source, Index block, Decomposition& d,
                                 Progress& progress) {
  StackedQr qr(source.columns());
  Eigen::MatrixXd rows(std::min(block, source.rows()), source.columns());
  for (Index first = 0; first < source.rows(); first += block) {
    auto part = rows.topRows(std::min(block, source.rows() - first));
    source.read_rows(first, part);
    d.energy += part.squaredNorm();
    qr.add(part);
    progress.add(part.size());
  }
  return std::move(qr.r());
}

/// R of the transpose, from blocks of columns.
Eigen::MatrixXd triangle_by_columns(SnapshotMatrix& source, Index block, Decomposition& d,
                                    Progress& progress) {
  StackedQr qr(source.rows());
  Eigen::MatrixXd columns(source.rows(), std::min(block, source.columns()));
  for (Index first = 0; first < source.columns(); first += block) {
    const Index n = std::min(block, source.columns() - first);
    source.read_columns(first, columns.leftCols(n));
    d.energy += columns.leftCols(n).squaredNorm();
    Eigen::MatrixXd turned = columns.leftCols(n).transpose();
    qr.add(turned);
    progress.add(turned.size());
  }
  return std::move(qr.r());
}

/// U = A V Σ⁻¹, orthonormalised by QR, whose diagonal is Σ.
void tall(SnapshotMatrix& source, const DecomposeOptions& options, const DecomposePlan& plan,
          Decomposition& d) {
  Progress progress(source, options, 2);
  {
    Eigen::MatrixXd r = triangle_by_rows(source, plan.block, d, progress);
    Svd small = thin_svd(r);
    d.sigma = std::move(small.sigma);
    d.temporal = std::move(small.v);
  }
  d.modes.resize(source.rows(), 0);
  const Index kept = rank_and_choose(d, options.modes, plan.modes);
  d.modes.setZero(source.rows(), kept);
  if (kept > 0) {
    // As many numbers at once as a block of rows has.
    const Index block =
        std::clamp<Index>(plan.block * source.columns() / source.rows(), 1, source.columns());
    Eigen::MatrixXd columns(source.rows(), block);
    for (Index first = 0; first < source.columns(); first += block) {
      const Index n = std::min(block, source.columns() - first);
      source.read_columns(first, columns.leftCols(n));
      multiply(columns.leftCols(n), d.temporal.block(first, 0, n, kept), d.modes, 1.0, 1.0);
      progress.add(source.rows() * n);
    }
    orthonormalise(d.modes);
  }
  progress.finish();
}

/// For the transpose: U from R, V = Aᵀ U Σ⁻¹.
void wide(SnapshotMatrix& source, const DecomposeOptions& options, const DecomposePlan& plan,
          Decomposition& d) {
  Progress progress(source, options, 2);
  Eigen::MatrixXd u;
  {
    Eigen::MatrixXd r = triangle_by_columns(source, plan.block, d, progress);
    Svd small = thin_svd(r);
    d.sigma = std::move(small.sigma);
    u = std::move(small.v);
  }
  d.modes.resize(source.rows(), 0);
  d.temporal.resize(source.columns(), 0);
  const Index kept = rank_and_choose(d, options.modes, plan.modes);
  d.modes = u.leftCols(kept);
  d.temporal.resize(source.columns(), std::min(d.rank, plan.modes));
  if (d.temporal.cols() > 0) {
    Eigen::MatrixXd columns(source.rows(), std::min(plan.block, source.columns()));
    for (Index first = 0; first < source.columns(); first += plan.block) {
      const Index n = std::min(plan.block, source.columns() - first);
      source.read_columns(first, columns.leftCols(n));
      multiply_transposed(columns.leftCols(n), u.leftCols(d.temporal.cols()),
                          d.temporal.middleRows(first, n));
      progress.add(source.rows() * n);
    }
    orthonormalise(d.temporal);
  }
  progress.finish();
}

}  // namespace

Decomposition tsqr(SnapshotMatrix& source, const DecomposeOptions& options,
                   const DecomposePlan& plan) {
  Decomposition d;
  d.method = Method::tsqr;
  if (source.rows() >= source.columns())
    tall(source, options, plan, d);
  else
    wide(source, options, plan, d);
  return d;
}

}  // namespace rondo::pod
