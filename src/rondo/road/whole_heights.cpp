// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/whole_heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace rondo::road {
namespace {

/// Indices of the first valid height of a row and of the one after the last; equal: there is none.
struct ValidRange {
  std::size_t begin, end;
};

ValidRange valid_range(std::span<const double> row) noexcept {
  std::size_t begin = 0, end = row.size();
  while (begin < end && std::isnan(row[begin])) ++begin;
  while (end > begin && std::isnan(row[end - 1])) --end;
  return {begin, end};
}

/// What stands on one side of a row, whose last valid height is given.
double height_beside(const Road& road, double last) noexcept {
  if (road.missing == Missing::last) return last + road.missing_offset;
  if (road.missing == Missing::zero) return road.missing_offset;
  return last;
}

void fill_row(const Road& road, ValidRange valid, std::span<double> row) noexcept {
  if (valid.begin == valid.end) return;
  const double right = height_beside(road, row[valid.begin]);
  const double left = height_beside(road, row[valid.end - 1]);
  std::fill(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(valid.begin), right);
  std::fill(row.begin() + static_cast<std::ptrdiff_t>(valid.end), row.end(), left);
}

/// Puts `height` where the row has no valid one.
void put_outside(ValidRange valid, double height, std::span<double> row) noexcept {
  for (std::size_t j = 0; j < row.size(); ++j)
    if (j < valid.begin || j >= valid.end) row[j] = height;
}

}  // namespace

std::vector<double> whole_heights(const Road& road, const Edges& edges) {
  std::vector<double> whole = road.heights;
  const std::size_t n_v = road.n_v();
  const bool outside = road.missing == Missing::keep;
  for (std::size_t i = 0; i < road.n_u(); ++i) {
    const std::span<double> row(whole.data() + i * n_v, n_v);
    const ValidRange valid = valid_range(row);
    fill_row(road, valid, row);
    const double banking = road.banking.size() > 1 ? road.banking[i] : road.banking.front();
    for (std::size_t j = 0; j < n_v; ++j) row[j] += road.line_height[i] + banking * road.v[j];
    if (outside && edges.v == Border::zero) put_outside(valid, edges.offset_v, row);
    if (outside && edges.v == Border::none)
      put_outside(valid, std::numeric_limits<double>::quiet_NaN(), row);
  }
  return whole;
}

}  // namespace rondo::road
