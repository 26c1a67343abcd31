// SPDX-License-Identifier: BSD-3-Clause
/// @file  The compliance of a window of a ring (docs/reduced.md): displacements of the contact
/// nodes of some sectors, one after the other, by forces on them.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rondo::rom {

/// Blocks depend on the lag alone, the sector that is moved less the sector that is pressed. They
/// are kept side by side, so that each column, and each row, of the whole matrix is a part of one
/// long column or row. The compliance of a smaller window is the leading part.
class WindowCompliance {
 public:
  /// Makes room, and allocates only for more than there was ever before. What was there is lost.
  /// @param size of a block @param sectors of the window
  void resize(Eigen::Index size, Eigen::Index sectors);
  /// @param lag -sectors < lag < sectors @param block (size, size) [m/N]
  void set(Eigen::Index lag, const Eigen::MatrixXd& block);

  /// Number of rows of the whole matrix.
  [[nodiscard]] Eigen::Index size() const noexcept { return size_ * sectors_; }
  /// (size()) A column.
  [[nodiscard]] const double* column(Eigen::Index j) const noexcept {
    return columns_.data() + j % size_ * rows() + (sectors_ - 1 - j / size_) * size_;
  }
  /// (size()) A row in single precision.
  [[nodiscard]] const float* rounded(Eigen::Index i) const noexcept {
    return rounded_.data() + i % size_ * rows() + (sectors_ - 1 - i / size_) * size_;
  }

 private:
  /// Both matrices have so many rows.
  [[nodiscard]] Eigen::Index rows() const noexcept { return (2 * sectors_ - 1) * size_; }

  Eigen::Index size_ = 1, sectors_ = 0;
  std::vector<double> columns_;  ///< (rows(), size) blocks, lags ascending
  std::vector<float> rounded_;   ///< the same shape: transposed blocks, lags descending
};

}  // namespace rondo::rom
