// SPDX-License-Identifier: BSD-3-Clause
/// @file  Options of a run, and how it ended.
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"

namespace rondo::study {

struct SharedBody;

enum class RunStatus { done, interrupted, failed };

/// In place of a file of RunOptions::reduced.
inline constexpr const char* wheel_of_case = "case";

struct RunOptions {
  std::filesystem::path directory;
  int threads = 0;                          ///< 0: chosen by the size of the body
  bool overwrite = false;                   ///< replace another run's results in the directory
  bool resume = false;                      ///< resume the run in the directory, if there is one
  const std::atomic<bool>* stop = nullptr;  ///< if true, end cleanly after the current step
  /// Called from time to time with the number of steps done and of all steps; may be empty.
  std::function<void(long long, long long)> progress;
  std::function<void()> before_loop;  ///< called once, before anything is written; may be empty
  std::function<void(const std::string&)> warn;  ///< receives warnings; may be empty
  SharedBody* shared = nullptr;                  ///< see build()
  bool keeps_checkpoint = true;                  ///< of its end, once it has finished
  /// Reduced wheel: a file of rondo reduce; wheel_of_case: made of the case; empty: the mesh.
  std::filesystem::path reduced;
  std::optional<long long> reduced_modes;  ///< of a wheel made of the case; none: chosen
  std::optional<double> reduced_step;      ///< of a reduced wheel; none: chosen            [s]
  std::optional<double> law_residual;      ///< of one in three dimensions; none: chosen
  bool reduced_estimate = false;           ///< of its errors
  std::filesystem::path modes_from;        ///< run whose modes start a crush by LATIN-PGD; or empty
  std::string modes_told;                  ///< its name in run.json; empty: modes_from
};

/// How a run ended. `failed` is a numerical outcome: a number not finite, or a residual too large.
struct RunReport {
  RunStatus status = RunStatus::failed;
  std::string message;             ///< of a failure: quantity, value, bound, step and time
  std::string reached;             ///< in words, e.g. "6023 steps to t = 0.12 s"
  std::vector<std::string> notes;  ///< of this kind of analysis, for the user
  long long steps = 0;             ///< steps or increments done
  bool resumable = true;           ///< whether it keeps checkpoints
  bool was_complete = false;       ///< --resume, but it had already finished: nothing was done
  long long resumed_at = 0;        ///< step of its checkpoint; 0: not resumed
  double end_time = 0.0;           ///< reached [s]; 0: no motion in time
  double loop_wall_s = 0.0;
  double simulated_s = 0.0;      ///< time simulated in this call; 0: no motion in time
  double step_wall_s = 0.0;      ///< reduced run: of its steps alone; else of the loop
  double slowest_step = 0.0;     ///< reduced run: wall time / simulated time
  double ns_per_dof_step = 0.0;  ///< 0: has no meaning
  double energy_residual_relative = 0.0;
  double energy_residual_bound = 0.0;  ///< a larger residual ends the run as failed
  double contact_residual_max = 0.0;
  double penetration_max_m = 0.0;
  double strain_max = 0.0;    ///< largest |principal strain| of the run
  double jacobian_min = 1.0;  ///< smallest J at a corner of an element in the run
  std::size_t snapshots = 0;
  std::vector<std::string> warnings;  ///< known only from the run; the caller prints them
};

/// Bound of both residuals, which are round-off: a larger one stops the run.
inline constexpr double residual_bound = 1e-9;

/// Bound of the ledger's residual for free linear elastic bodies: in large rotation the ledger
/// closes only to second order in the step (docs/theory.md, section 9).
inline constexpr double free_residual_bound = 1e-2;

}  // namespace rondo::study
