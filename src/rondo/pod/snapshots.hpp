// SPDX-License-Identifier: BSD-3-Clause
/// @file  The input of a decomposition: a matrix of weighted snapshots that need not fit in memory.
#pragma once
#include <Eigen/Core>
#include <utility>

namespace rondo::pod {

using Eigen::Index;

/// Rows are the weighted numbers of a field, columns the snapshots: W^{1/2} S of docs/theory.md
/// (7.1). Reading again gives the same bits.
class SnapshotMatrix {
 public:
  virtual ~SnapshotMatrix() = default;
  [[nodiscard]] virtual Index rows() const noexcept = 0;
  [[nodiscard]] virtual Index columns() const noexcept = 0;
  /// Blocks of rows start at multiples of this, because a ring of sectors cannot be read in parts.
  [[nodiscard]] virtual Index row_grain() const noexcept = 0;
  /// Reads all rows of the columns [first, first + out.cols()).
  virtual void read_columns(Index first, Eigen::Ref<Eigen::MatrixXd> out) = 0;
  /// Reads rows [first, first + out.rows()) of all columns. @pre first a multiple of row_grain().
  virtual void read_rows(Index first, Eigen::Ref<Eigen::MatrixXd> out) = 0;
};

/// Snapshots that are already in memory.
class DenseSnapshots final : public SnapshotMatrix {
 public:
  explicit DenseSnapshots(Eigen::MatrixXd values) : values_(std::move(values)) {}
  [[nodiscard]] Index rows() const noexcept override { return values_.rows(); }
  [[nodiscard]] Index columns() const noexcept override { return values_.cols(); }
  [[nodiscard]] Index row_grain() const noexcept override { return 1; }
  void read_columns(Index first, Eigen::Ref<Eigen::MatrixXd> out) override {
    out = values_.middleCols(first, out.cols());
  }
  void read_rows(Index first, Eigen::Ref<Eigen::MatrixXd> out) override {
    out = values_.middleRows(first, out.rows());
  }

 private:
  Eigen::MatrixXd values_;
};

}  // namespace rondo::pod
