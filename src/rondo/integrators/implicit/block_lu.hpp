// SPDX-License-Identifier: BSD-3-Clause
/// @file  LU factors of a sparse matrix of 2×2 blocks whose pattern is symmetric and whose
/// symmetric part is positive definite, so that it needs no exchanges of rows (Golub, Van Loan,
/// Matrix Computations, 4.3.2). Libraries factor by single numbers, or allocate in each solution;
/// one a step is made here, with the gyroscopic terms in it.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rondo/fem/assembly.hpp"

namespace rondo::dynamics {

class BlockLu {
 public:
  using Block = fem::BlockCsr::Block;  ///< column-major

  BlockLu() = default;
  /// @param a (n) rows; every row has its diagonal block. Ordered by minimum degree.
  /// @pre the pattern is symmetric, a + aᵀ positive definite. @throws std::bad_alloc
  explicit BlockLu(const fem::BlockCsr& a);

  /// Right side in, solution out; (n) each. Allocates nothing.
  void solve(std::span<double> x, std::span<double> y) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return place_.size(); }
  /// Blocks below the diagonal.
  [[nodiscard]] std::size_t n_blocks() const noexcept { return row_.size(); }

 private:
  void order(const fem::BlockCsr& a);
  void find_pattern(const fem::BlockCsr& a);
  void take_values(const fem::BlockCsr& a);
  void eliminate(std::size_t k);
  [[nodiscard]] std::size_t find(std::size_t column, int row) const noexcept;

  std::vector<int> place_;           ///< (n) row of the factor of each row
  std::vector<int> of_;              ///< (n) the reverse
  std::vector<std::int64_t> start_;  ///< (n + 1) first block of a column of L, of a row of U
  std::vector<int> row_;             ///< (blocks) row of L, column of U
  std::vector<Block> lower_, upper_, inverse_;  ///< L, U without diagonal, inverses of U's diagonal
  std::vector<Vec2> work_;                      ///< (n)
};

}  // namespace rondo::dynamics
