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

/// Rows of numbers round the ring, with room for as many sectors before the first and after the
/// last.
class RingRows {
 public:
  RingRows() = default;
  RingRows(int rows, int sectors);

  /// Sector 0 of a row.
  [[nodiscard]] double* row(int i) noexcept { return values_.data() + lead_ + i * stride_; }
  [[nodiscard]] const double* row(int i) const noexcept {
    return values_.data() + lead_ + i * stride_;
  }
  [[nodiscard]] std::ptrdiff_t stride() const noexcept { return stride_; }
  /// So many sectors before and after each row, from its own
  void wrap(int by) noexcept;

 private:
  int rows_ = 0, sectors_ = 0;
  std::ptrdiff_t lead_ = 0, stride_ = 0;
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

  /// Right side in, solution out. Allocates nothing.
  void solve(RingRows& x) noexcept;
  /// Levels of the reduction: the coupling is below round-off after them.
  [[nodiscard]] std::size_t n_levels() const noexcept { return levels_.size(); }

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

 private:
  struct Level {
    Matrix left, right;  ///< minus left here⁻¹, minus right here⁻¹
    int shift;           ///< sectors that it couples over, less whole rounds
  };

  int rows_, sectors_;
  RingProduct product_;
  std::vector<Level> levels_;
  Matrix inverse_;  ///< inverse of what is left of `here`
  RingRows work_;
};

}  // namespace rondo::dynamics
