// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/implicit/block_lu.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

using Block = BlockLu::Block;

constexpr Vec2 times(const Block& a, Vec2 x) noexcept {
  return {a[0] * x.x + a[2] * x.y, a[1] * x.x + a[3] * x.y};
}

constexpr Block times(const Block& a, const Block& b) noexcept {
  return {a[0] * b[0] + a[2] * b[1], a[1] * b[0] + a[3] * b[1], a[0] * b[2] + a[2] * b[3],
          a[1] * b[2] + a[3] * b[3]};
}

constexpr void take_away(Block& from, const Block& b) noexcept {
  for (std::size_t i = 0; i < 4; ++i) from[i] -= b[i];
}

Block inverse_of(const Block& a) noexcept {
  const double det = a[0] * a[3] - a[2] * a[1];
  RONDO_ASSERT(!(det <= 0.0), det);  // the symmetric part is positive definite
  return {a[3] / det, -a[1] / det, -a[2] / det, a[0] / det};
}

}  // namespace

BlockLu::BlockLu(const fem::BlockCsr& a) : work_(a.n_rows()) {
  RONDO_DEMAND(a.column.size() == a.values.size(), a.column.size(), a.values.size());
  order(a);
  find_pattern(a);
  take_values(a);
  for (std::size_t k = 0; k < size(); ++k) eliminate(k);
}

void BlockLu::order(const fem::BlockCsr& a) {
  const auto n = static_cast<Eigen::Index>(a.n_rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t row = 0; row < a.n_rows(); ++row)
    for (auto at = a.row_start[row]; at < a.row_start[row + 1]; ++at)
      entries.emplace_back(static_cast<int>(row), a.column[static_cast<std::size_t>(at)], 1.0);
  Eigen::SparseMatrix<double> graph(n, n);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int> amd;
  Eigen::AMDOrdering<int>::PermutationType reverse;
  amd(graph.selfadjointView<Eigen::Lower>(), reverse);
  of_.assign(reverse.indices().data(), reverse.indices().data() + n);
  place_.resize(of_.size());
  for (std::size_t k = 0; k < of_.size(); ++k)
    place_[static_cast<std::size_t>(of_[k])] = static_cast<int>(k);
}

/// Rows below the diagonal of a column: its own of the matrix, and those of the columns that it is
/// the first row of.
void BlockLu::find_pattern(const fem::BlockCsr& a) {
  const std::size_t n = a.n_rows();
  std::vector<std::vector<int>> rows(n);
  start_.assign(1, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const auto of = static_cast<std::size_t>(of_[k]);
    for (auto at = a.row_start[of]; at < a.row_start[of + 1]; ++at) {
      const int row = place_[static_cast<std::size_t>(a.column[static_cast<std::size_t>(at)])];
      if (row > static_cast<int>(k)) rows[k].push_back(row);
    }
    std::sort(rows[k].begin(), rows[k].end());
    rows[k].erase(std::unique(rows[k].begin(), rows[k].end()), rows[k].end());
    row_.insert(row_.end(), rows[k].begin(), rows[k].end());
    start_.push_back(static_cast<std::int64_t>(row_.size()));
    if (rows[k].empty()) continue;
    std::vector<int>& parent = rows[static_cast<std::size_t>(rows[k].front())];
    parent.insert(parent.end(), rows[k].begin() + 1, rows[k].end());
    rows[k] = {};
  }
  lower_.assign(row_.size(), Block{});
  upper_.assign(row_.size(), Block{});
  inverse_.assign(n, Block{});
}

std::size_t BlockLu::find(std::size_t column, int row) const noexcept {
  const auto begin = row_.begin() + start_[column], end = row_.begin() + start_[column + 1];
  const auto found = std::lower_bound(begin, end, row);
  RONDO_ASSERT(found != end && *found == row, column, row);  // the pattern is symmetric
  return static_cast<std::size_t>(found - row_.begin());
}

void BlockLu::take_values(const fem::BlockCsr& a) {
  for (std::size_t row = 0; row < a.n_rows(); ++row)
    for (auto at = a.row_start[row]; at < a.row_start[row + 1]; ++at) {
      const auto b = static_cast<std::size_t>(at);
      const int i = place_[row], j = place_[static_cast<std::size_t>(a.column[b])];
      if (i == j)
        inverse_[static_cast<std::size_t>(i)] = a.values[b];
      else if (i > j)
        lower_[find(static_cast<std::size_t>(j), i)] = a.values[b];
      else
        upper_[find(static_cast<std::size_t>(i), j)] = a.values[b];
    }
}

void BlockLu::eliminate(std::size_t k) {
  inverse_[k] = inverse_of(inverse_[k]);
  const auto first = static_cast<std::size_t>(start_[k]);
  const auto last = static_cast<std::size_t>(start_[k + 1]);
  for (std::size_t i = first; i < last; ++i) lower_[i] = times(lower_[i], inverse_[k]);
  for (std::size_t i = first; i < last; ++i) {
    const auto row = static_cast<std::size_t>(row_[i]);
    take_away(inverse_[row], times(lower_[i], upper_[i]));
    for (std::size_t j = i + 1; j < last; ++j) {  // both of (row i, column j) and its mirror
      const std::size_t at = find(row, row_[j]);
      take_away(lower_[at], times(lower_[j], upper_[i]));
      take_away(upper_[at], times(lower_[i], upper_[j]));
    }
  }
}

void BlockLu::solve(std::span<double> x, std::span<double> y) noexcept {
  const std::size_t n = size();
  RONDO_ASSERT(x.size() == n && y.size() == n, x.size(), y.size(), n);
  for (std::size_t k = 0; k < n; ++k) {
    const auto of = static_cast<std::size_t>(of_[k]);
    work_[k] = {x[of], y[of]};
  }
  for (std::size_t k = 0; k < n; ++k)
    for (auto i = static_cast<std::size_t>(start_[k]); i < static_cast<std::size_t>(start_[k + 1]);
         ++i)
      work_[static_cast<std::size_t>(row_[i])] -= times(lower_[i], work_[k]);
  for (std::size_t k = n; k-- > 0;) {
    Vec2 sum = work_[k];
    for (auto i = static_cast<std::size_t>(start_[k]); i < static_cast<std::size_t>(start_[k + 1]);
         ++i)
      sum -= times(upper_[i], work_[static_cast<std::size_t>(row_[i])]);
    work_[k] = times(inverse_[k], sum);
    const auto of = static_cast<std::size_t>(of_[k]);
    x[of] = work_[k].x;
    y[of] = work_[k].y;
  }
}

}  // namespace rondo::dynamics
