// SPDX-License-Identifier: BSD-3-Clause
/// @file  LU factors of a general band matrix in memory that is kept, with row exchanges (Golub,
/// Van Loan, Matrix Computations, 4.3). LAPACK has it too; problems here are small, and the solver
/// of contacts allocates nothing once its memory is large enough.
#pragma once
#include <span>
#include <vector>

namespace rondo::contact {

class BandLu {
 public:
  /// Zero matrix of order n with entries where |row - column| <= width.
  void reset(int n, int width);

  /// @pre |row - column| <= width
  [[nodiscard]] double& at(int row, int column) noexcept;

  /// Replaces the matrix by its factors; false where a pivot is zero or not finite.
  [[nodiscard]] bool factorise() noexcept;

  /// x (n) comes in as the right side and leaves as the solution. @pre factorise() was true
  void solve(std::span<double> x) const noexcept;

  [[nodiscard]] int order() const noexcept { return n_; }
  /// Numbers that reset(n, width) needs.
  static long long entries(long long n, long long width) noexcept { return n * (3 * width + 1); }

 private:
  [[nodiscard]] std::size_t place(int row, int column) const noexcept;

  int n_ = 0, width_ = 0;
  std::vector<double> a_;   ///< (n, 3 width + 1): columns row - width ... row + 2 width
  std::vector<int> pivot_;  ///< (n) row exchanged with
};

}  // namespace rondo::contact
