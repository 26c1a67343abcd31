// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/band.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rondo::contact {

std::size_t BandLu::place(int row, int column) const noexcept {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(3 * width_ + 1) +
         static_cast<std::size_t>(column - row + width_);
}

double& BandLu::at(int row, int column) noexcept {
  return a_[place(row, column)];
}

void BandLu::reset(int n, int width) {
  n_ = n;
  width_ = width;
  a_.assign(static_cast<std::size_t>(entries(n, width)), 0.0);
  pivot_.resize(static_cast<std::size_t>(n));
}

bool BandLu::factorise() noexcept {
  for (int k = 0; k < n_; ++k) {
    const int last_row = std::min(k + width_, n_ - 1);
    const int last_column = std::min(k + 2 * width_, n_ - 1);
    int best = k;
    for (int i = k + 1; i <= last_row; ++i)
      if (std::abs(at(i, k)) > std::abs(at(best, k))) best = i;
    pivot_[static_cast<std::size_t>(k)] = best;
    if (best != k)
      for (int j = k; j <= last_column; ++j) std::swap(at(k, j), at(best, j));
    const double pivot = at(k, k);
    if (pivot == 0.0 || !std::isfinite(pivot)) return false;
    for (int i = k + 1; i <= last_row; ++i) {
      const double factor = at(i, k) / pivot;
      at(i, k) = factor;
      if (factor == 0.0) continue;
      for (int j = k + 1; j <= last_column; ++j) at(i, j) -= factor * at(k, j);
    }
  }
  return true;
}

void BandLu::solve(std::span<double> x) const noexcept {
  const auto entry = [&](int row, int column) { return a_[place(row, column)]; };
  const auto at_x = [&](int i) -> double& { return x[static_cast<std::size_t>(i)]; };
  for (int k = 0; k < n_; ++k) {
    std::swap(at_x(k), at_x(pivot_[static_cast<std::size_t>(k)]));
    for (int i = k + 1; i <= std::min(k + width_, n_ - 1); ++i) at_x(i) -= entry(i, k) * at_x(k);
  }
  for (int k = n_ - 1; k >= 0; --k) {
    double sum = at_x(k);
    for (int j = k + 1; j <= std::min(k + 2 * width_, n_ - 1); ++j) sum -= entry(k, j) * at_x(j);
    at_x(k) = sum / entry(k, k);
  }
}

}  // namespace rondo::contact
