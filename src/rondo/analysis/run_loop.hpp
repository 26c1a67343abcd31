// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps of a run: from the start or from a checkpoint to the end, a signal or a
/// failure.
#pragma once
#include <string>

#include "rondo/analysis/run.hpp"
#include "rondo/model/ledger.hpp"
#include "rondo/output/checkpoint.hpp"
#include "rondo/output/run_output.hpp"

namespace rondo::study {

struct ReducedRun;

/// How the steps went, those before the checkpoint included.
struct Loop {
  RunStatus status = RunStatus::done;
  std::string message;
  ContactStatistics contact;
  dynamics::Balance balance;
  long long steps = 0;
  double wall_s = 0.0;
  double cpu_s = 0.0;
  int dumped = 0;             ///< contact problems kept as files
  std::size_t snapshots = 0;  ///< in the files, once these are closed
  OutputCost output;          ///< likewise
};

struct LoopPlan {
  const Case& c;
  const RunOptions& options;
  const RunIdentity& identity;    ///< for the checkpoints
  Checkpoint* from = nullptr;     ///< absent: from the start; its fields are freed once taken
  ReducedRun* reduced = nullptr;  ///< absent: the full model
};

/// Takes the initial fields of the setup, which are not needed twice. @throws FileError
[[nodiscard]] Loop run_loop(const LoopPlan& plan, Setup& setup, RunOutput& output);

}  // namespace rondo::study
