// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact points at one phase of the disk, and the Delassus blocks between those points for
/// which they were needed (docs/reduced.md, 5).
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/rom/contact_rows.hpp"
#include "rondo/rom/step_matrices.hpp"

namespace rondo::rom {

/// Velocities in the law at a point from a unit impulse at another point, both along x and y of the
/// model's frame (R.4).
struct DelassusPair {
  Eigen::Matrix2d normal, tangential;  ///< [m/kg]
};

/// Row-major, because it is read row by row.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class ContactTable {
 public:
  /// @param carried (2m, r) H D, of points fixed in space, whose approach to the ground is that of
  /// fixed places; empty: points that move with the material
  ContactTable(const rom::ContactRows& rows, const MatrixXd& carried);

  [[nodiscard]] std::size_t size() const noexcept { return points_.size(); }
  [[nodiscard]] Vec2 point(int k) const noexcept { return points_[static_cast<std::size_t>(k)]; }
  /// Length of deformed boundary that belongs to a point: stretched like the distance to the
  /// adjacent points. @param q (r) displacement [m]
  [[nodiscard]] double length(int k, const VectorXd& q) const;
  /// Length of undeformed boundary that belongs to a point [m].
  [[nodiscard]] double share(int k) const noexcept { return share_[static_cast<std::size_t>(k)]; }
  /// Norm of the rows: |H q| <= reach |q|.
  [[nodiscard]] double reach(int k) const noexcept { return reach_[static_cast<std::size_t>(k)]; }
  /// H at a point, times coefficients (r).
  [[nodiscard]] Vec2 at(int k, const VectorXd& coefficients) const;
  /// H D at a point, times coefficients (r). @pre stands_still()
  [[nodiscard]] Vec2 carried(int k, const VectorXd& coefficients) const;
  [[nodiscard]] bool stands_still() const noexcept { return carried_.size() > 0; }
  /// push += Hᵀ r
  void add_push(int k, Vec2 impulse, VectorXd& push) const;

  /// Computes the blocks between all these points that do not exist yet.
  void prepare(std::span<const int> points, const StepMatrices& matrices);
  /// @pre both points were prepared
  [[nodiscard]] DelassusPair pair(int at, int from) const noexcept;
  /// Forgets all blocks, because they belong to other matrices.
  void forget() noexcept;
  /// The points of each prepare() since the last forget() that added blocks.
  [[nodiscard]] std::vector<std::vector<int>> portions() const;
  /// Memory with blocks between `points` points [bytes].
  [[nodiscard]] static double bytes(std::size_t m, Index modes, std::size_t points) noexcept;

 private:
  void grow(Index slots);

  RowMatrix rows_, carried_;                ///< (2m, r)
  std::vector<Vec2> points_;                ///< (m)
  std::vector<double> share_;               ///< (m) undeformed
  std::vector<std::array<int, 2>> beside_;  ///< (m)
  std::vector<double> reach_;               ///< (m)
  std::vector<int> slot_;                   ///< (m) -1: none
  std::vector<int> known_;                  ///< points in the order of the slots
  std::vector<std::size_t> portion_ends_;   ///< ends, in known_, of each prepare() that added some
  RowMatrix slot_rows_, slot_carried_;      ///< (2 slots, r)
  MatrixXd dq_, dp_;                        ///< (r, 2 slots) at the end of the step
  MatrixXd normal_, tangential_;  ///< (2 slots, 2 slots); tangential_ empty: same as normal_
};

}  // namespace rondo::rom
