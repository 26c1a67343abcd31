// SPDX-License-Identifier: BSD-3-Clause
/// Memory of each method, counted in numbers of 8 bytes.
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/pod/decompose.hpp"

namespace rondo::pod {
namespace {

/// Counts are doubles because those of wrong inputs may exceed any integer.
struct Sizes {
  double rows, columns, grain;
  double allowed;  ///< numbers that fit into memory
  double asked;    ///< modes, < 0: no request

  [[nodiscard]] double shorter() const { return std::min(rows, columns); }
  [[nodiscard]] double longer() const { return std::max(rows, columns); }
  /// A triangle, its singular vectors on both sides, and three times its size of work for gesdd.
  [[nodiscard]] double small_svd() const { return 6.0 * shorter() * shorter(); }
  [[nodiscard]] double svd_flops() const { return 22.0 * std::pow(shorter(), 3); }
  [[nodiscard]] double modes_at_least() const {
    return asked < 0.0 ? 1.0 : std::clamp(asked, 1.0, shorter());
  }
};

DecomposePlan make(Method method, double block, double modes, double numbers, double flops) {
  return {method, static_cast<Index>(block), static_cast<Index>(modes),
          static_cast<std::size_t>(8.0 * numbers), flops};
}

DecomposePlan plan_direct(const Sizes& s) {
  const double modes = s.asked < 0.0 ? s.shorter() : s.modes_at_least();
  // Besides A, the vectors of the longer side: the modes, or all of V.
  const double vectors = s.rows >= s.columns ? s.rows * modes : s.columns * s.rows + s.rows * modes;
  const double n = s.shorter();
  const double numbers = s.rows * s.columns + std::max(s.small_svd(), 3.0 * n * n + vectors);
  const double flops =
      2.0 * s.longer() * s.shorter() * s.shorter() + s.svd_flops() + 4.0 * vectors * s.shorter();
  return make(Method::direct, s.columns, modes, numbers, flops);
}

/// Before the SVD a triangle and a block; then the work space of the SVD; then U or V of the longer
/// side, the vectors of the shorter side and a block.
DecomposePlan plan_tsqr(const Sizes& s) {
  constexpr double block_numbers = 1 << 24;
  const bool tall = s.rows >= s.columns;
  const double grain = tall ? s.grain : 1.0, n = s.shorter();
  // Blocks of columns also need a transposed copy.
  const double copies = tall ? 1.0 : 2.0;
  // The second pass has less memory; without a requested number, modes may use half of it.
  const double beside = s.allowed - 2.0 * n * n - s.longer() * s.modes_at_least();
  const double room = std::min(block_numbers, s.asked < 0.0 ? 0.5 * beside : beside) / (copies * n);
  const double fewest = std::min(grain, s.longer());
  const double block =
      std::clamp(grain * std::floor(room / grain), fewest, std::max(fewest, s.longer()));
  // The second pass reads whole columns, at least one.
  const double second = tall ? std::max(block * n, s.rows) : block * n;
  // The memory for the decomposition of the triangle is free again afterwards.
  const double left = (std::max(s.allowed, s.small_svd()) - second - 2.0 * n * n) / s.longer();
  const double modes = s.asked < 0.0 ? std::clamp(std::floor(left), 1.0, n) : s.modes_at_least();
  const double numbers = std::max(
      {2.0 * n * n + copies * block * n, s.small_svd(), second + 2.0 * n * n + s.longer() * modes});
  const double flops = 2.0 * s.longer() * n * n + s.svd_flops() + 2.0 * s.longer() * n * modes +
                       4.0 * s.longer() * modes * modes;
  return make(Method::tsqr, block, modes, numbers, flops);
}

/// U with an adjacent block, and V, each of w = modes + block columns, and work space of order w².
DecomposePlan plan_incremental(const Sizes& s) {
  constexpr double square = 12.0, largest_block = 128.0, at_once = 512.0;
  const double per_column = s.rows + s.columns + at_once;
  const double widest =
      (std::sqrt(per_column * per_column + 4.0 * square * s.allowed) - per_column) / (2.0 * square);
  const double width = std::max(2.0, std::floor(widest));
  double modes = std::min(s.shorter(), std::ceil(0.75 * width));
  const double block = std::clamp(width - modes, 1.0, std::min(largest_block, s.columns));
  modes = std::clamp(width - block, 1.0, s.shorter());
  const double w = modes + block;
  const double numbers = per_column * w + square * w * w;
  const double blocks = std::ceil(s.columns / block);
  const double flops = blocks * (s.rows * (8.0 * modes * block + 4.0 * block * block +
                                           2.0 * w * modes + 2.0 * modes * modes) +
                                 22.0 * w * w * w);
  return make(Method::incremental, block, modes, numbers, flops);
}

}  // namespace

DecomposePlan plan(Index rows, Index columns, Index row_grain, const DecomposeOptions& options) {
  RONDO_DEMAND(rows > 0 && columns > 0 && row_grain > 0, rows, columns, row_grain);
  RONDO_DEMAND(options.tolerance >= 0.0, options.tolerance);
  const Sizes sizes{static_cast<double>(rows), static_cast<double>(columns),
                    static_cast<double>(row_grain), static_cast<double>(options.memory) / 8.0,
                    static_cast<double>(options.modes)};
  const bool short_enough = std::min(rows, columns) <= largest_side;
  RONDO_DEMAND(
      short_enough || options.method == Method::automatic || options.method == Method::incremental,
      rows, columns, largest_side);
  if (options.method == Method::direct) return plan_direct(sizes);
  if (options.method == Method::tsqr) return plan_tsqr(sizes);
  if (options.method == Method::incremental) return plan_incremental(sizes);
  for (const DecomposePlan& p : {plan_direct(sizes), plan_tsqr(sizes)})
    if (short_enough && p.memory <= options.memory) return p;
  return plan_incremental(sizes);
}

}  // namespace rondo::pod
