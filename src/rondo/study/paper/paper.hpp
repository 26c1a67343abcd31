// SPDX-License-Identifier: BSD-3-Clause
/// @file  The study of the paper: its runs and decompositions, several at once, into one directory,
/// and the table of ours against expected (docs/paper.md, docs/results.md).
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "rondo/analysis/run.hpp"
#include "rondo/study/paper/paper_table.hpp"
#include "rondo/study/sweep/jobs.hpp"

namespace rondo::study {

struct PaperRequest {
  std::filesystem::path directory;
  bool quick = false;                       ///< coarse meshes
  bool overwrite = false;                   ///< do again what is there
  int at_once = 0;                          ///< jobs; 0: as many as there are cores
  const std::atomic<bool>* stop = nullptr;  ///< set: end cleanly
  /// Called once with the jobs to be done and the number of those that were there already.
  std::function<void(std::span<const Job>, std::size_t kept)> begin;
  std::function<void(std::size_t job, const JobOutcome& outcome)> ended;
  std::function<void(const JobsProgress& progress)> progress;
};

struct PaperReport {
  RunStatus status = RunStatus::failed;  ///< failed: a job failed or a row of the table
  int code = job_done;         ///< of the first job that failed; job_failed where rows failed
  std::string message;         ///< of a failure
  std::vector<PaperRow> rows;  ///< empty unless all jobs are done
  std::size_t done = 0, kept = 0, jobs = 0;  ///< jobs done now, there already, in all
  double wall_s = 0.0;
};

/// What is complete in the directory, of the same program and the same cases, is kept: a study that
/// was killed goes on where it was. Needs a process without threads (jobs.hpp).
/// @throws InputError: the directory holds something else; FileError
[[nodiscard]] PaperReport run_paper(const PaperRequest& request);

}  // namespace rondo::study
