// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rows of history.csv of motion in time: forces as means over the interval since the last
/// row, the ledger at half a step before, probes as they are at the row's time.
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

/// Where the rows of history.csv stand between two steps.
struct HistoryPlace {
  /// In place of `next`: no row is due, but finish() gives that of all steps.
  static constexpr long long never = std::numeric_limits<long long>::max();

  long long next = 1;   ///< number of the next row's interval
  long long steps = 0;  ///< since the last row
  long long done = 0;   ///< the last step seen
  Vec3 impulse;         ///< as ContactReport, since the last row             [N·s/m], [N·s]
  double angular_impulse = 0.0, penetration = 0.0;
  Vec2 hub_impulse{};  ///< of what holds a loaded rim, likewise                    [N·s/m]
  double hub_angular_impulse = 0.0;
  int iterations = 0, extensions = 0;        ///< of contact, most in a step since the last row
  double aligning = 0.0, overturning = 0.0;  ///< in three dimensions, since the last row [N·m·s]
};

class History {
 public:
  /// Who has measured the contact length of a step's report.
  enum class Length {
    undeformed,  ///< of undeformed edges: a row measures it, with the state
    deformed,    ///< as it is in a row
  };
  /// c.output.history_interval 0: every step. Case and setup must outlive the object.
  History(const Case& c, const Setup& setup, const HistoryPlace& place = {},
          Length reported = Length::undeformed);
  [[nodiscard]] const HistoryPlace& place() const noexcept { return at_; }
  [[nodiscard]] std::vector<ColumnLabel> columns() const;
  /// Every step, in turn: appends a row where one is due.
  /// @param state of this step, as needs_state() and needs_boundary() say; null: what is of it is
  /// NaN
  void observe(const dynamics::StepReport& step, const dynamics::State* state,
               std::vector<double>& rows);
  /// No step comes after the one seen last: its row, where none was due.
  void finish(const dynamics::StepReport& step, const dynamics::State* state,
              std::vector<double>& rows);
  /// Rows have numbers of the whole state, those of probes.
  [[nodiscard]] bool needs_state() const noexcept { return !setup_.probes.empty(); }
  /// Rows have numbers of the displacements of the contact boundary: the deformed contact length.
  [[nodiscard]] bool needs_boundary() const noexcept { return boundary_ != nullptr; }
  /// The next step that gives a row; never: none does.
  [[nodiscard]] long long next_row() const noexcept;

 private:
  [[nodiscard]] double slip_ratio(const dynamics::StepReport& step) const;
  [[nodiscard]] bool is_due(double time) const noexcept;
  [[nodiscard]] double contact_length(const dynamics::StepReport& step,
                                      const dynamics::State* state) const;
  void append_row(const dynamics::StepReport& step, const dynamics::State* state,
                  std::vector<double>& rows);
  void append_probes(const dynamics::State* state, std::vector<double>& rows) const;

  const Case& case_;
  const Setup& setup_;
  double dt_, interval_;
  double radius_ = 0.0;  ///< of what rolls; 0: nothing does                       [m]
  HistoryFeatures features_;
  std::shared_ptr<const mesh::DeformedBoundary> boundary_;  ///< null: reports have the length
  HistoryPlace at_;
};

}  // namespace rondo::study
