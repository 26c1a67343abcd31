// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/pod/svd.hpp"

namespace rondo::pod {

Spectrum spectrum(const Decomposition& d) {
  const auto n = static_cast<std::size_t>(d.sigma.size());
  Spectrum s{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  if (!(d.energy > 0.0)) return s;
  CompensatedSum head;
  for (std::size_t i = 0; i < n; ++i) {
    const double sigma = d.sigma[static_cast<Index>(i)];
    s.energy[i] = sigma * sigma / d.energy;
    head.add(s.energy[i]);
    s.cumulative[i] = head.value();
  }
  // Summed from the smallest on, because a sum that starts at the largest would lose them.
  CompensatedSum tail;
  tail.add(d.lost_energy / d.energy);
  for (std::size_t i = n; i-- > 0; tail.add(s.energy[i])) s.discarded[i] = tail.value();
  return s;
}

Index modes_for(const Spectrum& s, double share) {
  if (s.energy.empty()) return 0;
  if (s.discarded.front() + s.energy.front() <= share) return 0;
  const auto enough = std::find_if(s.discarded.begin(), s.discarded.end(),
                                   [&](double discarded) { return discarded <= share; });
  return enough == s.discarded.end() ? -1 : enough - s.discarded.begin() + 1;
}

namespace {

/// Adds the errors of a block of snapshots; `a` becomes its part outside all modes.
void add_errors(const Decomposition& d, const IdentityOptions& options,
                Eigen::Ref<Eigen::MatrixXd> a, Eigen::Ref<Eigen::MatrixXd> parts, Identity& out) {
  for (Index j = 0; j < a.cols(); ++j) out.snapshot_energy.push_back(a.col(j).squaredNorm());
  multiply_transposed(d.modes, a, parts);
  multiply(d.modes, parts, a, -1.0, 1.0);
  for (Index j = 0; j < a.cols(); ++j) {
    const double error = a.col(j).squaredNorm();
    out.squared_error.push_back(error);
    for (std::size_t k = 0; k < options.fewer.size(); ++k)
      out.fewer_error[k].push_back(error +
                                   parts.col(j).tail(out.modes - options.fewer[k]).squaredNorm());
  }
}

}  // namespace

Identity check_identity(SnapshotMatrix& snapshots, const Decomposition& d,
                        const IdentityOptions& options) {
  RONDO_DEMAND(snapshots.rows() == d.modes.rows() && snapshots.columns() == d.temporal.rows(),
               snapshots.rows(), d.modes.rows(), snapshots.columns(), d.temporal.rows());
  RONDO_DEMAND(options.block > 0, options.block);
  const OneBlasThread one_thread;
  Identity out;
  out.modes = d.modes.cols();
  for (const Index q : options.fewer) RONDO_DEMAND(q >= 0 && q <= out.modes, q, out.modes);
  out.fewer_error.resize(options.fewer.size());
  out.orthonormality = orthonormality(d.modes);
  Eigen::MatrixXd columns(snapshots.rows(), std::min(options.block, snapshots.columns()));
  Eigen::MatrixXd parts(out.modes, columns.cols());
  for (Index first = 0; first < snapshots.columns(); first += options.block) {
    const Index n = std::min(options.block, snapshots.columns() - first);
    snapshots.read_columns(first, columns.leftCols(n));
    add_errors(d, options, columns.leftCols(n), parts.leftCols(n), out);
    if (options.progress) options.progress(snapshots.rows() * n);
  }
  CompensatedSum energy, residual, tail;
  for (const double e : out.snapshot_energy) energy.add(e);
  if (!(energy.value() > 0.0)) return out;
  for (const double e : out.squared_error) residual.add(e / energy.value());
  tail.add(d.lost_energy / energy.value());
  for (Index i = d.sigma.size(); i-- > out.modes;)
    tail.add(d.sigma[i] * d.sigma[i] / energy.value());
  out.residual = residual.value();
  out.tail = tail.value();
  out.difference = std::abs(out.residual - out.tail);
  return out;
}

}  // namespace rondo::pod
