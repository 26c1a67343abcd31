// SPDX-License-Identifier: BSD-3-Clause
/// @file  Stiffness of contact nodes without mass, factorised once (docs/theory.md, 3.10): K_cc of
/// the nodes themselves, K_ci to the nodes with mass around them.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/contact/coupled/coupled.hpp"
#include "rondo/fem/assembly.hpp"

namespace rondo::dynamics {

/// Nodes that K joins to these, ascending, without these.
[[nodiscard]] std::vector<int> nodes_beside(const fem::BlockCsr& k, std::span<const int> nodes);

class RingMatrix {
 public:
  /// Memory for kept columns of the inverse, at the most, but for those that touch [bytes].
  static constexpr std::size_t column_memory = std::size_t{1} << 28;

  /// @param nodes (nc) without mass, none clamped
  RingMatrix(const fem::BlockCsr& k, std::span<const int> nodes);

  /// False: parts of the ring can move without strain, as if nothing held them. Nothing else may
  /// be asked then.
  [[nodiscard]] bool is_positive_definite() const noexcept { return positive_definite_; }

  [[nodiscard]] std::span<const int> nodes() const noexcept { return nodes_; }
  /// (ni) nodes with mass that K_ci reaches, ascending.
  [[nodiscard]] std::span<const int> neighbours() const noexcept { return neighbours_; }

  /// K_cc u_c + K_ci u_i into `out` (nc), by differences of displacements: large translations leave
  /// no round-off of their size. @param u (nc + ni) of nodes(), then of neighbours() [m]
  void product(std::span<const Vec2> u, std::span<Vec2> out) const noexcept;
  /// x := K_cc⁻¹ x (nc).
  void solve(std::span<Vec2> x) noexcept;
  /// (nc) 2×2 blocks of column j of K_cc⁻¹, found where it is first asked for and then kept, as far
  /// as memory allows. Good until the next release(). Allocates where it is found anew.
  [[nodiscard]] std::span<const contact::Block> inverse_column(int j);
  /// Columns that are not asked for from here on may give way to others.
  void release() noexcept { ++round_; }

 private:
  struct Column {
    int node = -1;
    long long asked = 0;  ///< round in which it was asked for last
    std::vector<contact::Block> blocks;
  };

  void take_rows(const fem::BlockCsr& k);
  [[nodiscard]] fem::BlockCsr::Block sum_of_row(std::size_t row) const noexcept;
  void factorise(const fem::BlockCsr& k);
  std::size_t slot_for_new_column();

  std::vector<int> nodes_, neighbours_;
  std::vector<int> row_start_, column_;              ///< rows of K_c, columns as in product()
  std::vector<fem::BlockCsr::Block> values_, held_;  ///< blocks; (nc) sums of rows
  bool positive_definite_ = false;
  // P K_cc Pᵀ = L Lᵀ, L by columns, the diagonal first.
  std::vector<int> permutation_, factor_start_, factor_row_;
  std::vector<double> factor_;
  std::vector<double> work_;      ///< (2 nc)
  std::vector<Vec2> unit_;        ///< (nc)
  std::vector<int> slot_;         ///< (nc) place in columns_, -1: not there
  std::vector<Column> columns_;   ///< kept ones
  std::size_t most_columns_ = 0;  ///< that memory allows
  std::size_t next_to_give_ = 0;  ///< where a place is looked for
  long long round_ = 0;
};

}  // namespace rondo::dynamics
