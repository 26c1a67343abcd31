// SPDX-License-Identifier: BSD-3-Clause
/// @file  The loop of every analysis: from its start or from a checkpoint to its end, a signal or a
/// failure; at once, or in pieces.
#pragma once
#include <chrono>
#include <cstddef>
#include <ctime>
#include <functional>
#include <string>

#include "rondo/analysis/base/analysis.hpp"

namespace rondo::study {

/// How the loop went, what was before a checkpoint included.
struct Loop {
  RunStatus status = RunStatus::done;
  std::string message;  ///< message of a failure
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double last_time = 0.0;     ///< time of the last row of history.csv, once closed
  std::size_t snapshots = 0;  ///< in the files, once these are closed
  OutputCost output;          ///< cost of these files, once closed
};

struct LoopPlan {
  Analysis& analysis;
  const RunOptions& options;
  double checkpoint_interval = 60.0;  ///< [s of wall time]
  const Checkpoint* from = nullptr;   ///< gone on from; null: from the start
  std::function<void()> before_save;  ///< before a checkpoint is handed over; may be empty
};

/// begin(), advance() until is_over(), finish(). Each throws FileError.
class Looper {
 public:
  /// The members of the plan and the recorder must outlive it.
  Looper(const LoopPlan& plan, Recorder& recorder);
  /// Records the start.
  void begin();
  /// At its end, failed, or stopped.
  [[nodiscard]] bool is_over() const noexcept {
    return loop_.status != RunStatus::done || at_.done >= at_.all;
  }
  /// The analysis' next steps or increment, and what is due with them.
  void advance();
  /// A checkpoint now. @pre the analysis is resumable; not failed
  void save() { save({}); }
  /// Stops where it is: finish() then leaves a run that can be resumed.
  void interrupt() noexcept;
  /// Hands over the last row and, if there is to be one, the last checkpoint.
  [[nodiscard]] Loop finish();

 private:
  using Clock = std::chrono::steady_clock;
  void look_for_trouble();
  void start_time();
  void count_time();
  [[nodiscard]] bool is_save_due() const;
  void save(std::vector<double> last_row);

  const LoopPlan plan_;
  Analysis& analysis_;
  Recorder& recorder_;
  Loop loop_;
  Progress at_;
  Clock::time_point since_{}, saved_{};  ///< time counted last, checkpoint handed over last
  std::clock_t cpu_since_ = 0;
};

}  // namespace rondo::study
