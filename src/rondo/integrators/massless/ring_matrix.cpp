// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/massless/ring_matrix.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

/// Pivots below this share of the largest are round-off: a mechanism.
constexpr double least_pivot = 1e-12;
/// Sums of rows below this share of their entries are round-off.
constexpr double round_off = 1e-13;

Vec2 times(const fem::BlockCsr::Block& block, Vec2 v) noexcept {
  return {block[0] * v.x + block[2] * v.y, block[1] * v.x + block[3] * v.y};
}

}  // namespace

std::vector<int> nodes_beside(const fem::BlockCsr& k, std::span<const int> nodes) {
  std::vector<char> seen(k.n_rows(), 0);
  std::vector<int> beside;
  for (const int node : nodes) seen[at(node)] = 1;
  for (const int node : nodes)
    for (auto b = k.row_start[at(node)]; b < k.row_start[at(node) + 1]; ++b) {
      const int other = k.column[at(b)];
      if (std::exchange(seen[at(other)], char{1}) == 0) beside.push_back(other);
    }
  std::sort(beside.begin(), beside.end());
  return beside;
}

RingMatrix::RingMatrix(const fem::BlockCsr& k, std::span<const int> nodes)
    : nodes_(nodes.begin(), nodes.end()),
      neighbours_(nodes_beside(k, nodes)),
      work_(2 * nodes.size()),
      unit_(nodes.size()),
      slot_(nodes.size(), -1) {
  RONDO_DEMAND(k.column.size() == k.values.size() && nodes.size() <= k.n_rows(), k.column.size(),
               k.values.size(), nodes.size(), k.n_rows());
  take_rows(k);
  factorise(k);
  const std::size_t column = std::max<std::size_t>(nodes.size(), 1) * sizeof(contact::Block);
  most_columns_ = std::min(nodes.size(), std::max<std::size_t>(column_memory / column, 64));
  columns_.reserve(nodes.size());
}

void RingMatrix::take_rows(const fem::BlockCsr& k) {
  std::vector<int> place(k.n_rows(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) place[at(nodes_[i])] = static_cast<int>(i);
  for (std::size_t i = 0; i < neighbours_.size(); ++i)
    place[at(neighbours_[i])] = static_cast<int>(nodes_.size() + i);
  row_start_.push_back(0);
  for (const int node : nodes_) {
    for (auto b = k.row_start[at(node)]; b < k.row_start[at(node) + 1]; ++b) {
      column_.push_back(place[at(k.column[at(b)])]);
      values_.push_back(k.values[at(b)]);
    }
    row_start_.push_back(static_cast<int>(column_.size()));
    held_.push_back(sum_of_row(row_start_.size() - 2));
  }
}

/// The block by which nodes that never move hold the row; round-off counts as nothing.
fem::BlockCsr::Block RingMatrix::sum_of_row(std::size_t row) const noexcept {
  fem::BlockCsr::Block sum{};
  double largest = 0.0;
  for (int b = row_start_[row]; b < row_start_[row + 1]; ++b)
    for (std::size_t e = 0; e < sum.size(); ++e) {
      sum[e] += values_[at(b)][e];
      largest = std::max(largest, std::abs(values_[at(b)][e]));
    }
  const bool nothing = std::ranges::all_of(
      sum, [&](double entry) { return std::abs(entry) <= round_off * largest; });
  return nothing ? fem::BlockCsr::Block{} : sum;
}

void RingMatrix::factorise(const fem::BlockCsr& k) {
  if (nodes_.empty()) return;
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky(
      fem::free_matrix(k, nodes_));
  if (cholesky.info() != Eigen::Success) return;
  const Eigen::SparseMatrix<double> lower = cholesky.matrixL();
  const Eigen::VectorXd pivots = lower.diagonal();
  positive_definite_ =
      pivots.minCoeff() * pivots.minCoeff() > least_pivot * pivots.maxCoeff() * pivots.maxCoeff();
  const auto& p = cholesky.permutationP().indices();
  permutation_.assign(p.data(), p.data() + p.size());
  factor_start_.assign(lower.outerIndexPtr(), lower.outerIndexPtr() + lower.cols() + 1);
  factor_row_.assign(lower.innerIndexPtr(), lower.innerIndexPtr() + lower.nonZeros());
  factor_.assign(lower.valuePtr(), lower.valuePtr() + lower.nonZeros());
}

void RingMatrix::product(std::span<const Vec2> u, std::span<Vec2> out) const noexcept {
  RONDO_ASSERT(u.size() == nodes_.size() + neighbours_.size() && out.size() == nodes_.size(),
               u.size(), out.size(), nodes_.size(), neighbours_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Vec2 sum = times(held_[i], u[i]);
    for (int b = row_start_[i]; b < row_start_[i + 1]; ++b)
      sum += times(values_[at(b)], u[at(column_[at(b)])] - u[i]);
    out[i] = sum;
  }
}

void RingMatrix::solve(std::span<Vec2> x) noexcept {
  RONDO_ASSERT(positive_definite_ && x.size() == nodes_.size(), x.size(), nodes_.size());
  double* y = work_.data();
  const int n = static_cast<int>(permutation_.size());
  for (int i = 0; i < n; i += 2) {
    y[permutation_[at(i)]] = x[at(i / 2)].x;
    y[permutation_[at(i + 1)]] = x[at(i / 2)].y;
  }
  for (int j = 0; j < n; ++j) {
    const double value = y[j] /= factor_[at(factor_start_[at(j)])];
    for (int e = factor_start_[at(j)] + 1; e < factor_start_[at(j + 1)]; ++e)
      y[factor_row_[at(e)]] -= factor_[at(e)] * value;
  }
  for (int j = n - 1; j >= 0; --j) {
    double sum = y[j];
    for (int e = factor_start_[at(j)] + 1; e < factor_start_[at(j + 1)]; ++e)
      sum -= factor_[at(e)] * y[factor_row_[at(e)]];
    y[j] = sum / factor_[at(factor_start_[at(j)])];
  }
  for (int i = 0; i < n; i += 2)
    x[at(i / 2)] = {y[permutation_[at(i)]], y[permutation_[at(i + 1)]]};
}

/// One that was not asked for in this round gives way where there are as many as memory allows.
std::size_t RingMatrix::slot_for_new_column() {
  for (std::size_t tried = 0; columns_.size() >= most_columns_ && tried < columns_.size();
       ++tried) {
    const std::size_t slot = next_to_give_;
    next_to_give_ = (next_to_give_ + 1) % columns_.size();
    if (columns_[slot].asked == round_) continue;
    slot_[at(columns_[slot].node)] = -1;
    return slot;
  }
  columns_.emplace_back().blocks.resize(nodes_.size());
  return columns_.size() - 1;
}

std::span<const contact::Block> RingMatrix::inverse_column(int j) {
  RONDO_ASSERT(positive_definite_ && j >= 0 && at(j) < nodes_.size(), j, nodes_.size());
  if (slot_[at(j)] < 0) {
    const std::size_t slot = slot_for_new_column();
    slot_[at(j)] = static_cast<int>(slot);
    columns_[slot].node = j;
    for (const std::size_t component : {0U, 1U}) {
      std::fill(unit_.begin(), unit_.end(), Vec2{});
      unit_[at(j)] = component == 0 ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0};
      solve(unit_);
      for (std::size_t i = 0; i < unit_.size(); ++i) {
        columns_[slot].blocks[i][component] = unit_[i].x;
        columns_[slot].blocks[i][component + 2] = unit_[i].y;
      }
    }
  }
  Column& column = columns_[at(slot_[at(j)])];
  column.asked = round_;
  return column.blocks;
}

}  // namespace rondo::dynamics
