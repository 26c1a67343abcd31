// SPDX-License-Identifier: BSD-3-Clause
/// @file  A parametric study: many runs of one case, by a team (docs/studies.md).
#pragma once
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rondo/study/sweep/sweep_members.hpp"

namespace rondo::study {

struct SweepRequest {
  std::filesystem::path study;        ///< file
  std::vector<std::string> settings;  ///< "a.b=value", for all members, before what is varied
  std::filesystem::path directory;
  bool overwrite = false;  ///< what a study has left there is removed
  bool resume = false;     ///< a study there is gone on with
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string&)> warn;  ///< takes warnings; may be empty
  /// Takes what is done with the members ("read", "check"), how many are done, of how many; may be
  /// empty.
  std::function<void(const char* what, long long done, long long all)> checking;
  /// Called once all is checked, before the directory is touched: from here on signals ask for a
  /// clean end. May be empty.
  std::function<void()> before_files;
  /// Called before the first run; may be empty.
  std::function<void(const PlannedSweep& plan, int workers)> begin;
  /// Runs that have ended, and all of them; may be empty.
  std::function<void(long long ended, long long all)> progress;
};

struct SweepReport {
  std::size_t members = 0, done = 0, failed = 0, interrupted = 0;
  std::size_t kept = 0;               ///< of those done and failed, that were there already
  int code = 0;                       ///< of the worst failure, as of a run; 130: interrupted
  std::vector<std::string> failures;  ///< some, with the run's number
  std::size_t strained = 0;           ///< of those done, whose largest strain is above small_strain
  double strain_max = 0.0;            ///< the largest of all
  std::size_t strain_run = 0;         ///< the run that has it, from 1; 0: none has a strain
  double wall_s = 0.0;
};

/// What was built of a study, and would be run.
struct DrySweep {
  SweepStudy study;
  PlannedSweep plan;
};

/// Checks all members and estimates their time. @throws InputError
[[nodiscard]] DrySweep check_sweep(const SweepRequest& request, Team& team);

/// All members of the team call it; the report is the same for all. @throws InputError: the study,
/// or some member, is wrong, or the directory holds something else: nothing was run; FileError
[[nodiscard]] SweepReport run_sweep(const SweepRequest& request, Team& team);

/// Directories of the runs of a sweep that are done, ascending; empty: it is no sweep.
/// @throws FileError
[[nodiscard]] std::vector<std::filesystem::path> runs_of_sweep(
    const std::filesystem::path& directory);

}  // namespace rondo::study
