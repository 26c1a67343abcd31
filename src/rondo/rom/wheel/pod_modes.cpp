// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/pod_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd;

/// Energies of less than this share of the largest are round-off of the sums.
constexpr double least_energy = 1e-13;

double weight_of(std::size_t k) {
  return k == 0 ? 1.0 : 2.0;
}

}  // namespace

FieldHarmonics::FieldHarmonics(const Ring& ring) : ring_(ring), rows_(inner_rows(ring)) {
  const int n = ring.n_sectors();
  RONDO_DEMAND(n > 1, n);
  root_.resize(static_cast<Index>(rows_.size()));
  for (Index r = 0; r < root_.size(); ++r) root_[r] = std::sqrt(ring.mass[at(rows_[at(r)] / 2)]);
  waves_.resize((n + 1) / 2, n);
  for (Index k = 0; k < waves_.rows(); ++k)
    for (int j = 0; j < n; ++j) {
      const Complex turn = ring.stiffness.turn[at(k * j % n)];
      waves_(k, j) = std::complex<double>(turn.re, -turn.im) / static_cast<double>(n);
    }
  field_.resize(n, root_.size());
  sums_.assign(at(waves_.rows()), MatrixXcd::Zero(root_.size(), root_.size()));
}

void FieldHarmonics::add(std::span<const Vec2> field) {
  for (int j = 0; j < ring_.n_sectors(); ++j) {
    const Complex back = conj(ring_.stiffness.turn[at(j)]);
    for (Index r = 0; r < root_.size(); r += 2) {
      const Vec2 x = back * field[ring_.stiffness.node(at(rows_[at(r)] / 2), at(j))];
      field_(j, r) = root_[r] * x.x;
      field_(j, r + 1) = root_[r + 1] * x.y;
    }
  }
  energy_ += field_.squaredNorm();
  const MatrixXcd harmonics = waves_ * field_;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const VectorXcd u = harmonics.row(static_cast<Index>(k)).transpose();
    sums_[k].noalias() += u * u.adjoint();
  }
}

PodModes FieldHarmonics::modes(int wanted) const {
  struct Mode {
    double energy;
    std::size_t k;
  };
  std::vector<Mode> all;
  std::vector<MatrixXcd> vectors;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    Axes<MatrixXcd> axes = axes_of(sums_[k]);
    vectors.push_back(std::move(axes.vectors));
    for (const double square : axes.values)
      all.push_back({ring_.n_sectors() * weight_of(k) * square, k});
  }
  std::ranges::stable_sort(all, std::greater<>(), &Mode::energy);
  std::vector<Index> taken(sums_.size());
  double inside = 0.0;
  int count = 0;
  for (const Mode& mode : all) {
    if (count >= wanted || !(mode.energy > least_energy * all.front().energy)) break;
    ++taken[mode.k];
    inside += mode.energy;
    count += mode.k == 0 ? 1 : 2;
  }
  PodModes found;
  for (std::size_t k = 0; k < taken.size(); ++k)
    if (taken[k] > 0)
      found.harmonics.push_back(
          ritz_harmonic(ring_, static_cast<int>(k), vectors[k].rightCols(taken[k])));
  found.left = energy_ > 0.0 ? std::max(0.0, 1.0 - inside / energy_) : 0.0;
  return found;
}

}  // namespace rondo::rom
