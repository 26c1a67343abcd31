// SPDX-License-Identifier: BSD-3-Clause
/// @file  A motion that its caller takes from step to step, looks at and drives: the same bits as
/// `rondo run`.
#pragma once
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "rondo/analysis/base/stepwise.hpp"
#include "rondo/analysis/run_session.hpp"
#include "rondo/analysis/simulation/memory_recorder.hpp"

namespace rondo::study {

/// Fields of the last step for those who look on, in memory that stays where it is.
struct ShownFields {
  std::size_t nodes = 0, components = 2;
  std::vector<double> displacement;  ///< (n, c) co-rotating frame; of free bodies fixed frame [m]
  std::vector<double> velocity;      ///< (n, c) half a step before                        [m/s]
};

using DrivenValue = std::pair<std::string, double>;  ///< a key of the case, its new value

/// Not to be used by two threads at once.
class Simulation {
 public:
  /// @param options `directory` empty: nothing is written, and no snapshot kept
  /// @throws InputError: the case cannot run, or is no motion in time; FileError
  Simulation(Case c, RunOptions options);
  /// Without finish() its files are left as by a run that was killed.
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  [[nodiscard]] const Case& case_as_driven() const noexcept { return case_; }
  [[nodiscard]] const Setup& setup() const noexcept { return stepwise_->setup(); }
  [[nodiscard]] long long steps_made() const noexcept { return stepwise_->steps_made(); }
  /// Time of the last step made [s].
  [[nodiscard]] double end_time() const noexcept;
  /// The run has come to its end, a failure or a stop.
  [[nodiscard]] bool is_over() const noexcept { return session_->is_over(); }
  /// The message of a failure; else empty.
  [[nodiscard]] std::string trouble() const;
  [[nodiscard]] const Json& json() const noexcept { return session_->json(); }

  /// Sets the step that go_on() goes to: at most the end.
  void aim(long long step);
  /// Steps until there, or for so many seconds [s]. True: it is there, or over. @throws FileError
  [[nodiscard]] bool go_on(double seconds);

  /// Leads tables in time over to values, all or none, from the next step but one on, in a time
  /// `over` (0: half a step); what they said of later times is dropped. After the last step nothing
  /// comes of it.
  /// @throws InputError: key, value, or what the steps cannot follow: nothing has changed then
  void drive(const std::vector<DrivenValue>& values, double over);
  /// Its value now. @throws InputError: it is no table in time
  [[nodiscard]] double driven(const std::string& key);

  /// Filled anew at each pause from now on; null: Stepwise::state() has none.
  [[nodiscard]] std::shared_ptr<const ShownFields> fields();
  [[nodiscard]] const dynamics::State* state() { return stepwise_->state(); }
  [[nodiscard]] std::vector<double> row() const { return stepwise_->row(); }
  /// Labels of row(), and of the rows kept in memory.
  [[nodiscard]] const std::vector<ColumnLabel>& columns() const noexcept { return columns_; }
  /// (rows, columns) of all so far, of a run in memory; null: history.csv has them
  [[nodiscard]] const std::vector<double>* rows() const noexcept;

  /// @throws InputError: it keeps no checkpoints, or is over; FileError
  void save();
  [[nodiscard]] bool keeps_checkpoints() const noexcept {
    return has_files() && analysis_->resumable() != nullptr;
  }
  /// The error of files that it was broken off by; null: none.
  [[nodiscard]] const FileError* broken_by() const noexcept { return session_->broken_by(); }
  [[nodiscard]] bool has_files() const noexcept { return !memory_.has_value(); }
  /// The end of it, wherever it is: closes the files, the last row is in the history. Nothing but
  /// what looks on may be called after it.
  [[nodiscard]] RunReport finish();

 private:
  void fill();
  void check_driven(const std::vector<DrivenValue>& values, double from);

  Case case_;
  const RunOptions options_;
  std::unique_ptr<Analysis> analysis_;
  Stepwise* stepwise_ = nullptr;
  std::vector<ColumnLabel> columns_;
  std::optional<MemoryRecorder> memory_;
  std::optional<RunSession> session_;
  long long target_ = 0;
  std::set<std::pair<std::string, bool>> checked_;  ///< keys that were set, to 0 or not
  std::shared_ptr<ShownFields> shown_;              ///< null: nobody looks
};

}  // namespace rondo::study
