// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rows of history.csv of a motion in time: forces are means over the interval since the
/// last row, the ledger is that of half a step before, probes are at the row's time.
#pragma once
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/mesh/deformed_boundary.hpp"
#include "rondo/output/columns.hpp"

namespace rondo::study {

/// The state of history.csv between two steps.
struct HistoryPlace {
  /// A value of `next`: no row is due, but finish() writes one for all steps.
  static constexpr long long never = std::numeric_limits<long long>::max();

  long long next = 1;   ///< index of the next row's interval
  long long steps = 0;  ///< since the last row
  long long done = 0;   ///< the last step seen
  Vec3 impulse;         ///< as in ContactReport, since the last row             [N·s/m], [N·s]
  double angular_impulse = 0.0, penetration = 0.0;
  Vec2 hub_impulse{};  ///< of the reactions on a loaded rim                        [N·s/m]
  double hub_angular_impulse = 0.0;
  int iterations = 0, extensions = 0;  ///< of contact, largest of a step since the last row
  // In three dimensions, since the last row: below the center, and about the contact centre.
  double aligning = 0.0, overturning = 0.0;          ///< [N·m·s]
  double aligning_iso = 0.0, overturning_iso = 0.0;  ///< [N·m·s]
};

class History {
 public:
  /// c.output.history_interval 0: a row per step. Case and setup must outlive the object.
  History(const Case& c, const Setup& setup, const HistoryPlace& place = {});
  [[nodiscard]] const HistoryPlace& place() const noexcept { return at_; }
  [[nodiscard]] std::vector<ColumnLabel> columns() const;
  /// Called at every step in order; appends a row if one is due.
  /// @param state of this step, if needs_state() or
  /// needs_boundary(); null: its columns are NaN
  void observe(const dynamics::StepReport& step, const dynamics::State* state,
               std::vector<double>& rows);
  /// Called after the last step: appends its row if none was due.
  void finish(const dynamics::StepReport& step, const dynamics::State* state,
              std::vector<double>& rows);
  /// Whether rows need the whole state, for probes.
  [[nodiscard]] bool needs_state() const noexcept { return !setup_.probes.empty(); }
  /// Whether rows need the displacements of the contact boundary, for the deformed contact length.
  [[nodiscard]] bool needs_boundary() const noexcept { return boundary_ != nullptr; }
  /// The next step that gives a row; never: there is none.
  [[nodiscard]] long long next_row() const noexcept;

 private:
  [[nodiscard]] double slip_ratio(const dynamics::StepReport& step) const;
  [[nodiscard]] bool is_due(double time) const noexcept;
  void measure_contact(const dynamics::StepReport& step, const dynamics::State* state,
                       HistoryRecord& row) const;
  void append_row(const dynamics::StepReport& step, const dynamics::State* state,
                  std::vector<double>& rows);
  void append_probes(const dynamics::State* state, std::vector<double>& rows) const;

  const Case& case_;
  const Setup& setup_;
  double dt_, interval_;
  double radius_ = 0.0;  ///< of the rolling body; 0: nothing rolls                       [m]
  HistoryFeatures features_;
  GroundFrame ground_;                                      ///< of the camber
  std::shared_ptr<const mesh::DeformedBoundary> boundary_;  ///< null: nothing touches
  HistoryPlace at_;
};

}  // namespace rondo::study
