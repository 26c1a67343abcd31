// SPDX-License-Identifier: BSD-3-Clause
/// One pass over blocks of snapshots: A ≈ U Σ Vᵀ so far, and bounds of the truncated part
/// (docs/theory.md, 7.2). After Brand (2006).
#include <algorithm>
#include <cmath>

#include "rondo/pod/methods.hpp"
#include "rondo/pod/svd.hpp"

namespace rondo::pod {
namespace {

/// U is orthonormalised again if its error is larger than this; 1e-13 is promised.
constexpr double drift_allowed = 2e-14;

struct Factors {
  Eigen::MatrixXd left;        ///< (rows, most + block) U, then the next block
  Eigen::MatrixXd right;       ///< (columns, most) V
  Eigen::VectorXd sigma;       ///< (k)
  Index seen = 0;              ///< number of columns so far
  double energy = 0.0;         ///< of these columns
  double lost = 0.0;           ///< truncated energy
  double bound_squared = 0.0;  ///< sum of the squares of the largest σ of each truncation

  [[nodiscard]] Index k() const noexcept { return sigma.size(); }
};

/// [[Σ, C], [0, R]] for the block B = U C + Q R; Q replaces B.
Eigen::MatrixXd project(Factors& f, Index n) {
  const Index k = f.k();
  const auto u = f.left.leftCols(k);
  auto b = f.left.middleCols(k, n);
  Eigen::MatrixXd c(k, n), again(k, n);
  multiply_transposed(u, b, c);
  multiply(u, c, b, -1.0, 1.0);
  // A second time, because the rest of b may be much smaller than b and contain round-off along U,
  // which mend() would have to remove.
  multiply_transposed(u, b, again);
  multiply(u, again, b, -1.0, 1.0);
  c += again;
  const Eigen::VectorXd factors = factor_qr(b);
  const Index q = factors.size();
  Eigen::MatrixXd small = Eigen::MatrixXd::Zero(k + q, k + n);
  small.topLeftCorner(k, k).diagonal() = f.sigma;
  small.topRightCorner(k, n) = c;
  small.bottomRightCorner(q, n) = upper(b);
  form_q(b, factors);
  return small;
}

/// Number of singular values to keep; `allowed` limits the square of the largest truncated one.
Index cut(const Eigen::VectorXd& sigma, Index most, double floor, double allowed) {
  Index k = std::min<Index>(most, (sigma.array() > floor).count());
  while (k > 0 && sigma[k - 1] * sigma[k - 1] <= allowed) --k;
  return k;
}

/// U ← [U Q] U', V ← [V 0; 0 I] V', both truncated.
void turn(Factors& f, Index n, const Svd& svd, Index kept) {
  const Index k = f.k(), q = svd.u.rows() - k;
  multiply_in_place(f.left.leftCols(k + q), svd.u.leftCols(kept));
  Eigen::MatrixXd rotation = svd.v.topLeftCorner(k, kept);
  if (kept > k) rotation.conservativeResizeLike(Eigen::MatrixXd::Zero(kept, kept));
  if (kept > k) f.right.topRows(f.seen).middleCols(k, kept - k).setZero();
  multiply_in_place(f.right.topRows(f.seen).leftCols(std::max(k, kept)), rotation);
  f.right.block(f.seen, 0, n, kept) = svd.v.block(k, 0, n, kept);
  f.sigma = svd.sigma.head(kept);
}

/// U = Q R; A ≈ Q (R Σ) Vᵀ, where R Σ has a singular value decomposition of its own.
void mend(Factors& f) {
  auto u = f.left.leftCols(f.k());
  if (f.k() == 0 || orthonormality(u) <= drift_allowed) return;
  const Eigen::VectorXd factors = factor_qr(u);
  Eigen::MatrixXd middle = upper(u) * f.sigma.asDiagonal();
  form_q(u, factors);
  const Svd svd = thin_svd(middle);
  multiply_in_place(u, svd.u);
  multiply_in_place(f.right.topRows(f.seen).leftCols(f.k()), svd.v);
  f.sigma = svd.sigma;
}

void truncate(Factors& f, const Svd& svd, Index kept) {
  const Index n = svd.sigma.size() - kept;
  if (n == 0) return;
  f.lost += svd.sigma.tail(n).squaredNorm();
  f.bound_squared += svd.sigma[kept] * svd.sigma[kept];
}

void add_block(Factors& f, Index n, Index most, double tolerance) {
  Eigen::MatrixXd small = project(f, n);
  const Svd svd = thin_svd(small);
  // The truncation allowed so far: its total times the share of the columns read.
  const double share = static_cast<double>(f.seen + n) / static_cast<double>(f.right.rows());
  const double allowed = tolerance * tolerance * f.energy * share - f.bound_squared;
  const double floor = round_off(f.left.rows(), f.right.rows(), svd.sigma[0]);
  const Index kept = cut(svd.sigma, most, floor, allowed);
  truncate(f, svd, kept);
  turn(f, n, svd, kept);
  f.seen += n;
  mend(f);
}

}  // namespace

Decomposition incremental(SnapshotMatrix& source, const DecomposeOptions& options,
                          const DecomposePlan& plan) {
  Progress progress(source, options, 1);
  Decomposition d;
  d.method = Method::incremental;
  Factors f;
  f.left.resize(source.rows(), plan.modes + plan.block);
  f.right.resize(source.columns(), plan.modes);
  for (Index first = 0; first < source.columns(); first += plan.block) {
    const Index n = std::min(plan.block, source.columns() - first);
    auto block = f.left.middleCols(f.k(), n);
    source.read_columns(first, block);
    f.energy += block.squaredNorm();
    add_block(f, n, plan.modes, options.tolerance);
    progress.add(source.rows() * n);
  }
  d.energy = f.energy;
  d.lost_energy = f.lost;
  d.sigma_bound = std::sqrt(f.bound_squared);
  d.sigma = f.sigma;
  // Shrinks in place, without copying.
  f.right.conservativeResize(Eigen::NoChange, f.k());
  d.temporal = std::move(f.right);
  d.modes.resize(source.rows(), 0);
  const Index kept = rank_and_choose(d, options.modes, plan.modes);
  f.left.conservativeResize(Eigen::NoChange, kept);
  d.modes = std::move(f.left);
  return d;
}

}  // namespace rondo::pod
