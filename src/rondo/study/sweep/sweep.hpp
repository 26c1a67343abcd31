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
  std::vector<std::string> settings;  ///< "a.b=value", for all members; varied keys override them
  std::filesystem::path directory;
  bool overwrite = false;  ///< remove the files of an earlier study there
  bool resume = false;     ///< resume a study there
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string&)> warn;  ///< receives warnings; may be empty
  /// Receives the stage of the members ("read",
  /// "check"), the number done and of all; may be empty.
  std::function<void(const char* what, long long done, long long all)> checking;
  /// Throws an InputError for the case of a member that is not to be run; may be empty.
  std::function<void(const Case&)> accept;
  /// Called when everything is checked, before the directory is changed; from then on a signal asks
  /// for a clean end. May be empty.
  std::function<void()> before_files;
  /// Called before the first run; may be empty.
  std::function<void(const PlannedSweep& plan, int workers)> begin;
  /// Receives the number of runs that have ended, and of all; may be empty.
  std::function<void(long long ended, long long all)> progress;
};

struct SweepReport {
  std::size_t members = 0, done = 0, failed = 0, interrupted = 0;
  std::size_t kept = 0;               ///< of those done and failed, the number that existed already
  int code = 0;                       ///< exit code of the worst failure; 130: interrupted
  std::vector<std::string> failures;  ///< some, with the run's number
  std::size_t strained = 0;           ///< number done with a largest strain above small_strain
  double strain_max = 0.0;            ///< the largest of all runs
  std::size_t strain_run = 0;         ///< number of that run, from 1; 0: no run has a strain
  double wall_s = 0.0;
};

/// The built members of a study that would be run.
struct DrySweep {
  SweepStudy study;
  PlannedSweep plan;
};

/// Checks all members and estimates their time. @throws InputError
[[nodiscard]] DrySweep check_sweep(const SweepRequest& request, Team& team);

/// All members of the team call it; the report is the same for all. @throws InputError: the study
/// or a member is wrong, or the directory contains something else, and nothing was run; FileError
[[nodiscard]] SweepReport run_sweep(const SweepRequest& request, Team& team);

/// Directories of the finished runs of a sweep, ascending; empty: it is not a sweep.
/// @throws FileError
[[nodiscard]] std::vector<std::filesystem::path> runs_of_sweep(
    const std::filesystem::path& directory);

}  // namespace rondo::study
