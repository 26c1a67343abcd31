// SPDX-License-Identifier: BSD-3-Clause
/// @file  The loop of every analysis: from its start or from a checkpoint to its end, a signal or a
/// failure.
#pragma once
#include <cstddef>
#include <string>

#include "rondo/analysis/base/analysis.hpp"

namespace rondo::study {

/// How the loop went, what was before a checkpoint included.
struct Loop {
  RunStatus status = RunStatus::done;
  std::string message;  ///< of a failure
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double last_time = 0.0;     ///< of the last row of history.csv, once closed
  std::size_t snapshots = 0;  ///< in the files, once these are closed
  OutputCost output;          ///< likewise
};

struct LoopPlan {
  Analysis& analysis;
  const RunOptions& options;
  double checkpoint_interval = 60.0;  ///< [s of wall time]
  const Checkpoint* from = nullptr;   ///< gone on from; null: from the start
};

/// @throws FileError
[[nodiscard]] Loop run_loop(const LoopPlan& plan, Recorder& recorder);

}  // namespace rondo::study
