// SPDX-License-Identifier: BSD-3-Clause
/// @file  The runs and PODs of the paper's study as jobs, and which of them are there already.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/study/paper/paper_plan.hpp"
#include "rondo/study/sweep/jobs.hpp"

namespace rondo::study {

/// A run or a POD of the plan.
struct PaperJob {
  Job job;
  std::string command;              ///< that does the same
  std::filesystem::path directory;  ///< of its results, relative to the study's
  bool is_pod = false;
  std::size_t of = 0;  ///< place in the plan's runs or pods
  bool there = false;  ///< complete, of this program and this case
  JobOutcome found;    ///< if it is there: how it ended
};

/// Runs first, then PODs, each after its run. @param again: nothing counts as being there
[[nodiscard]] std::vector<PaperJob> paper_jobs(const std::filesystem::path& directory,
                                               const PaperPlan& plan, bool again);

}  // namespace rondo::study
