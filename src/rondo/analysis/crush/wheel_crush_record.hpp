// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the crush of a wheel in three dimensions writes of an increment: its row of
/// history.csv and its snapshot.
#pragma once
#include <vector>

#include "rondo/analysis/build/crush/crush_path.hpp"
#include "rondo/mesh/deformed_boundary.hpp"
#include "rondo/output/recorder.hpp"
#include "rondo/statics/steady/standing.hpp"

namespace rondo::study {

/// Sums over the contact after an increment.
struct WheelCrushSums {
  int nodes = 0, sticking = 0;
  double area = 0.0;                   ///< deformed [m²]
  double length = 0.0, width = 0.0;    ///< of the footprint [m]
  double pressure = 0.0, shear = 0.0;  ///< largest  [Pa]
};

/// Increment k of a wheel; 0: first touch.
struct WheelCrushRow {
  const CrushPath& path;
  int k = 0;
  double floor = 0.0;  ///< height of the ground [m]
  GroundFrame ground;  ///< of the camber
  const statics::StandingState& state;
  const WheelCrushSums& sums;
};

class WheelCrushRecord {
 public:
  /// Both must outlive it.
  WheelCrushRecord(const mesh::Mesh& mesh, const statics::StandingWheel& wheel);

  /// @param ground of the camber
  [[nodiscard]] WheelCrushSums sum_up(const GroundFrame& ground) const;
  /// @param before (n) displacement one increment earlier [m]
  void fill(const WheelCrushRow& row, const std::vector<Vec3>& before, Snapshot& snapshot) const;

 private:
  /// Number in mesh.boundary of the node of a pair.
  [[nodiscard]] std::size_t candidate_of(std::size_t pair) const;

  const statics::StandingWheel& wheel_;
  mesh::DeformedBoundary boundary_;
  std::vector<std::size_t> candidate_of_node_;  ///< (n)
};

/// Labels of a row: those of every analysis, then those of the crush of a wheel.
std::vector<ColumnLabel> wheel_crush_columns();
/// @param rows of history.csv, one after another
void append_row(const WheelCrushRow& row, std::vector<double>& rows);
/// The curve of force over depth, a value for each snapshot.
std::vector<io::Series> wheel_crush_series();

}  // namespace rondo::study
