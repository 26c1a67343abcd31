// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/reduction/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/reduction/svd.hpp"

namespace rondo::reduction {

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
  // From the smallest on, which a sum from the largest would lose.
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

std::vector<double> squared_errors(const Decomposition& d, Index modes) {
  RONDO_DEMAND(modes >= 0 && modes <= d.sigma.size(), modes, d.sigma.size());
  const Index there = d.temporal.cols();
  std::vector<double> errors(static_cast<std::size_t>(d.temporal.rows()));
  for (Index j = 0; j < d.temporal.rows(); ++j) {
    double& error = errors[static_cast<std::size_t>(j)];
    if (there >= std::min(d.rank, d.sigma.size())) {
      for (Index i = there; i-- > modes;) error += std::pow(d.sigma[i] * d.temporal(j, i), 2);
    } else {  // the tail of V did not fit in memory
      RONDO_DEMAND(modes <= there, modes, there);
      error = d.snapshot_energy[j];
      for (Index i = 0; i < modes; ++i) error -= std::pow(d.sigma[i] * d.temporal(j, i), 2);
      error = std::max(error, 0.0);
    }
  }
  return errors;
}

Identity check_identity(SnapshotMatrix& snapshots, const Decomposition& d, Index block) {
  RONDO_DEMAND(snapshots.rows() == d.modes.rows() && snapshots.columns() == d.temporal.rows(),
               snapshots.rows(), d.modes.rows(), snapshots.columns(), d.temporal.rows());
  RONDO_DEMAND(block > 0, block);
  const OneThread one_thread;
  Identity out;
  out.modes = d.modes.cols();
  out.orthonormality = orthonormality(d.modes);
  CompensatedSum energy, residual, tail;
  Eigen::MatrixXd columns(snapshots.rows(), std::min(block, snapshots.columns()));
  Eigen::MatrixXd parts(d.modes.cols(), columns.cols());
  for (Index first = 0; first < snapshots.columns(); first += block) {
    const Index n = std::min(block, snapshots.columns() - first);
    auto a = columns.leftCols(n);
    snapshots.read_columns(first, a);
    for (Index j = 0; j < n; ++j) out.snapshot_energy.push_back(a.col(j).squaredNorm());
    multiply_transposed(d.modes, a, parts.leftCols(n));
    multiply(d.modes, parts.leftCols(n), a, -1.0, 1.0);
    for (Index j = 0; j < n; ++j) out.squared_error.push_back(a.col(j).squaredNorm());
  }
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

}  // namespace rondo::reduction
