// SPDX-License-Identifier: BSD-3-Clause
/// @file  What an analysis records, as arrays in memory instead of files.
#pragma once
#include <vector>

#include "rondo/output/recorder.hpp"

namespace rondo::study {

/// Snapshots one behind the other, as results.h5 has them (docs/results.md).
struct RecordedSnapshots {
  std::size_t count = 0;                      ///< t
  std::size_t nodes = 0, components = 2;      ///< n; 2 or 3 numbers of a vector: c
  std::size_t candidates = 0;                 ///< nb
  std::vector<double> time, time_velocity;    ///< (t)                                  [s]
  std::vector<double> angle, angle_velocity;  ///< (t)                                  [rad]
  std::vector<double> center;                 ///< (t, c)                               [m]
  std::vector<double> displacement;           ///< (t, n, c) co-rotating frame          [m]
  std::vector<double> velocity;               ///< (t, n, c)                            [m/s]
  std::vector<double> contact_force;          ///< (t, nb, c) normal, tangential        [N/m]
};

/// Memory of all snapshots of a plan [B].
[[nodiscard]] std::size_t memory_of_snapshots(const RecordPlan& plan) noexcept;

class MemoryRecorder : public Recorder {
 public:
  /// @param keeps_snapshots false: rows alone
  MemoryRecorder(const RecordPlan& plan, bool keeps_snapshots);

  void rows_added() override {}
  [[nodiscard]] Snapshot& next_snapshot() override { return next_; }
  void add_snapshot() override;
  /// Nothing goes on from memory.
  void save(Checkpoint /*checkpoint*/) override {}
  [[nodiscard]] bool is_saving() const noexcept override { return true; }
  void keep_up() override {}

  /// Labels of one row; the numbers of all are rows().
  [[nodiscard]] const std::vector<ColumnLabel>& columns() const noexcept { return columns_; }
  [[nodiscard]] RecordedSnapshots& snapshots() noexcept { return kept_; }

 private:
  void add_contact();

  const std::vector<ColumnLabel> columns_;
  const bool keeps_;
  Snapshot next_;
  RecordedSnapshots kept_;
};

}  // namespace rondo::study
