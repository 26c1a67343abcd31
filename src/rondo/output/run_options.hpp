// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a run is asked for, and how it ended.
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"

namespace rondo::study {

struct SharedBody;

enum class RunStatus { done, interrupted, failed };

struct RunOptions {
  std::filesystem::path directory;
  int threads = 0;         ///< 0: chosen by size
  bool overwrite = false;  ///< replace another run's results in the directory
  bool resume = false;     ///< go on with the run in the directory, if there is one
  const std::atomic<bool>* stop = nullptr;  ///< set: end cleanly after the step in hand
  /// Called now and then with steps done and steps in all; may be empty.
  std::function<void(long long, long long)> progress;
  std::function<void()> before_loop;  ///< called once, before anything is written; may be empty
  std::function<void(const std::string&)> warn;  ///< takes warnings; may be empty
  SharedBody* shared = nullptr;                  ///< as for build()
  bool keeps_checkpoint = true;                  ///< of its end, once it is done
  std::filesystem::path reduced;          ///< model to run on instead of the mesh; empty: the mesh
  double step_factor = 20.0;              ///< with it: step over that of the full run
  std::string reduced_step = "midpoint";  ///< with it: or "explicit"
  std::string reduced_snapshots = "fields";  ///< with it: or "modes", lifted when they are read
  std::filesystem::path modes_from;  ///< run whose modes a crush by LATIN-PGD begins with; or empty
  std::string modes_told;            ///< what run.json calls it; empty: as modes_from
};

/// How a run ended. `failed` is an outcome of the numerics: not finite, or a residual out of bound.
struct RunReport {
  RunStatus status = RunStatus::failed;
  std::string message;             ///< of a failure: quantity, value, bound, step and time
  std::string reached;             ///< in words, e.g. "6023 steps to t = 0.12 s"
  std::vector<std::string> notes;  ///< of this kind of analysis, for the user
  long long steps = 0;             ///< or increments, done
  bool resumable = true;           ///< it keeps checkpoints
  bool was_complete = false;       ///< to be resumed, but already at its end: nothing was done
  long long resumed_at = 0;        ///< step of the checkpoint that it went on from; 0: begun anew
  double end_time = 0.0;           ///< reached [s]; 0: no motion
  double loop_wall_s = 0.0;
  double simulated_s = 0.0;      ///< of motion, in this call; 0: there is none
  double step_wall_s = 0.0;      ///< of a reduced run: its steps alone; else the loop
  double slowest_step = 0.0;     ///< of a reduced run: over the time that it stands for
  double ns_per_dof_step = 0.0;  ///< 0: means nothing
  double energy_residual_relative = 0.0;
  double energy_residual_bound = 0.0;  ///< above which the run ends as failed
  double contact_residual_max = 0.0;
  double penetration_max_m = 0.0;
  double strain_max = 0.0;    ///< largest |principal strain| seen
  double jacobian_min = 1.0;  ///< smallest J at a corner of an element
  std::size_t snapshots = 0;
  std::vector<std::string> warnings;  ///< of what only the run could tell; the caller prints them
};

/// Bound of both residuals, which are round-off: beyond it a run stops.
inline constexpr double residual_bound = 1e-9;

/// Bound of the ledger's residual where linear elastic bodies are free: in large rotation it closes
/// to second order in the step only (docs/theory.md, section 9).
inline constexpr double free_residual_bound = 1e-2;

}  // namespace rondo::study
