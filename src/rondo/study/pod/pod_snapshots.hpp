// SPDX-License-Identifier: BSD-3-Clause
/// @file  The snapshots of runs as the matrix of a POD: chosen by time, moved to the requested
/// frame, weighted, read when needed (docs/theory.md, 7.1 and 7.3).
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "rondo/io/run_reader.hpp"
#include "rondo/pod/rectify.hpp"
#include "rondo/pod/snapshots.hpp"

namespace rondo::study {

enum class Weight { mass, delassus, none };

/// One snapshot of one run.
struct SnapshotColumn {
  std::size_t run = 0, snapshot = 0;
  double time = 0.0;    ///< of the field itself                                             [s]
  double angle = 0.0;   ///< of the rotating frame at that time                             [rad]
  double weight = 1.0;  ///< factor of the snapshot
};

struct SnapshotChoice {
  io::Quantity quantity = io::Quantity::displacement;
  Weight weight = Weight::mass;
  std::optional<pod::Shift> rectified;  ///< none: the rotating frame
};

/// Rows are components·i + component, where i is the index of a point in order(): ring after ring
/// in the rectified frame, so that blocks of rows can be rectified separately.
class RunSnapshots final : public pod::SnapshotMatrix {
 public:
  /// @pre all runs have the same mesh and outlive this; rectified only if the mesh has sectors.
  RunSnapshots(std::span<const io::RunReader> runs, std::vector<SnapshotColumn> columns,
               const SnapshotChoice& choice);

  [[nodiscard]] pod::Index rows() const noexcept override;
  [[nodiscard]] pod::Index columns() const noexcept override;
  [[nodiscard]] pod::Index row_grain() const noexcept override;
  /// @throws InputError: a number that is not finite; FileError
  void read_columns(pod::Index first, Eigen::Ref<Eigen::MatrixXd> out) override;
  void read_rows(pod::Index first, Eigen::Ref<Eigen::MatrixXd> out) override;

  /// The first run; all runs have its mesh.
  [[nodiscard]] const io::RunReader& run() const noexcept { return runs_.front(); }
  /// (n_points) W of each point, in the order of the mesh (or of its boundary).
  [[nodiscard]] const std::vector<double>& weight() const noexcept { return weight_; }
  /// Numbers per point: 2 in the plane, 3 in three dimensions.
  [[nodiscard]] std::size_t components() const noexcept { return components_; }
  /// Converts rows of a weighted field in place to numbers (components·point + component) of the
  /// field itself.
  void unweight(Eigen::Ref<Eigen::VectorXd> rows);

 private:
  void read_points(const SnapshotColumn& column, std::size_t first, std::span<Vec2> plane,
                   std::span<double> axial);
  void read_order(const SnapshotColumn& column, std::size_t first, std::size_t count);
  void rectify(const SnapshotColumn& column, std::span<Vec2> plane, std::span<double> axial);
  void store(Eigen::Ref<Eigen::VectorXd> out, const SnapshotColumn& column, std::size_t first,
             std::size_t count) const;

  std::span<const io::RunReader> runs_;
  std::vector<SnapshotColumn> columns_;
  SnapshotChoice choice_;
  pod::Rings rings_;            ///< empty: rotating
  std::vector<int> order_;      ///< (n_points) point at each index of the order
  std::vector<double> weight_;  ///< (n_points)
  std::vector<double> root_;    ///< (n_points) √W in order
  std::size_t components_ = 2;
  std::vector<Vec2> row_, field_;  ///< (n_points) as read; in order
  /// (n_points) the third components of both;
  /// (n_points, 3) as in the file. Empty in the plane.
  std::vector<double> axial_row_, axial_, numbers_;
  std::optional<pod::Rectifier> rectifier_;
  std::size_t rectifier_rings_ = 0;
  Eigen::VectorXd scratch_;  ///< (rows)
};

}  // namespace rondo::study
