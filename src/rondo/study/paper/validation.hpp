// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo reduce --validate`: runs that a reduced model was not built from, predicted with
/// it, and how far off the predictions are (docs/reduced.md, 10).
#pragma once
#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/run.hpp"
#include "rondo/study/paper/validation_measures.hpp"

namespace rondo::study {

struct ValidationRequest {
  std::filesystem::path model;
  std::vector<std::filesystem::path> held_out;    ///< results directories, or sweeps of such
  std::vector<std::filesystem::path> built_from;  ///< where the model is still to be built
  double step_factor = 20.0;
  std::string reduced_step = "midpoint";  ///< as of a run
  std::optional<double> from, to;  ///< window of the comparison [s]; none: last quarter of each run
  std::function<void(const std::string&)> warn;        ///< may be empty
  std::function<void(const std::string&)> begins;      ///< a prediction of that name; may be empty
  std::function<void(long long, long long)> progress;  ///< of it; may be empty
  std::function<void()> before_loop;                   ///< as of a run
  const std::atomic<bool>* stop = nullptr;             ///< as of a run
};

inline constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

/// Of the full run and of its prediction.
struct FullReduced {
  double full = no_figure, reduced = no_figure;
};

/// What a prediction missed; figures that there are none of are not a number.
struct ValidationFigures {
  double from = 0.0, to = 0.0;                                        ///< window [s]
  std::size_t snapshots = 0;                                          ///< of the full run, compared
  double displacement_left = no_figure, velocity_left = no_figure;    ///< by the modes at best [1]
  double displacement_error = no_figure, velocity_error = no_figure;  ///< of the prediction [1]
  /// Likewise of the means over the window: without what fluctuates.
  double displacement_mean_error = no_figure, velocity_mean_error = no_figure;
  double pressure_error = no_figure;  ///< of the mean profile, by the full one [1]
  double shear_error = no_figure;     ///< likewise, by the full pressure [1]
  FullReduced force_x, force_y;       ///< means [N/m]
  FullReduced force_x_fluctuation,
      force_y_fluctuation;                ///< root mean squares about the means [N/m]
  FullReduced friction_power;             ///< dissipated in the window [W/m]
  FullReduced steps, loop_wall, threads;  ///< [1], [s], [1]
  bool same_host = false;
};

/// A run held out, its prediction and what came of it.
struct Validated {
  std::string name;  ///< of the prediction's directory
  std::filesystem::path full, reduced;
  RunStatus status = RunStatus::failed;  ///< of the prediction; figures are there if it is done
  std::string message;                   ///< of one that failed
  ValidationFigures figures;
  Profile full_profile, reduced_profile;  ///< empty where there is no contact
};

struct ValidationReport {
  std::filesystem::path directory;
  std::vector<Validated> runs;

  /// The worst of all predictions.
  [[nodiscard]] RunStatus status() const noexcept;
};

/// MODEL-validation beside MODEL.h5.
[[nodiscard]] std::filesystem::path validation_directory(const std::filesystem::path& model);

/// Before a model is built: looks whether the runs can validate it. @throws InputError: another
/// mesh or material, not finished, a reduced run, no snapshots; FileError
void check_held_out(const ValidationRequest& request);

/// Predicts each of the runs into MODEL-validation/NAME, compares, and writes validation.csv,
/// validation.json and the profiles. @throws InputError as check_held_out(), and where a window
/// holds nothing; FileError
[[nodiscard]] ValidationReport validate(const ValidationRequest& request);

}  // namespace rondo::study
