// SPDX-License-Identifier: BSD-3-Clause
/// @file  Block-tridiagonal systems round a ring of equal sectors, left x_{j-1} + here x_j +
/// right x_{j+1} = b_j, by parallel cyclic reduction: as all sectors have the same blocks, so has
/// each level of it, whose coupling reaches twice as far and falls with the square (Hockney,
/// Jesshope, Parallel Computers, 1988, 5.4). For any number of sectors.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/integrators/implicit/ring_terms.hpp"

namespace rondo::dynamics {

/// Rows of numbers round the ring, as RingTerms has them.
class RingRows {
 public:
  RingRows() = default;
  RingRows(int rows, int sectors);

  [[nodiscard]] double* row(int i) noexcept { return values_.data() + i * stride_; }
  [[nodiscard]] const double* row(int i) const noexcept { return values_.data() + i * stride_; }
  [[nodiscard]] std::ptrdiff_t stride() const noexcept { return stride_; }
  /// The second round of each row from its first.
  void repeat() noexcept;

 private:
  int rows_ = 0, sectors_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<double> values_;
};

/// Blocks of a row of the matrix: what the last sector, the own and the next one do.
struct RingBlocks {
  Eigen::MatrixXd left, here, right;
};

class Circulant {
 public:
  /// @pre sectors >= 3; the symmetric part of the matrix is positive definite
  Circulant(int sectors, const RingBlocks& blocks, RingProduct product);

  /// Right side in, solution out, in the first round of `x`. Allocates nothing.
  void solve(RingRows& x) noexcept;
  /// Levels of the reduction: the coupling is below round-off after them.
  [[nodiscard]] std::size_t n_levels() const noexcept { return levels_.size(); }

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Level {
    Matrix left, right;  ///< minus left here⁻¹, minus right here⁻¹
    int shift;           ///< sectors that it couples over, modulo their number
  };

  int rows_, sectors_;
  RingProduct product_;
  std::vector<Level> levels_;
  Matrix inverse_;  ///< of what is left of `here`
  RingRows work_;
};

}  // namespace rondo::dynamics
