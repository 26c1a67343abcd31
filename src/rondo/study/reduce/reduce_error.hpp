// SPDX-License-Identifier: BSD-3-Clause
/// @file  Error estimate of a reduced model from the runs that it is built from: each is left out
/// in turn and predicted (docs/reduced.md, 8b).
#pragma once
#include <functional>
#include <limits>
#include <optional>

#include "rondo/analysis/error_estimate.hpp"
#include "rondo/case/case.hpp"
#include "rondo/io/run_reader.hpp"
#include "rondo/rom/reduced_model.hpp"

namespace rondo::study {

/// With fewer, a single run would have to predict another, which is not meaningful.
inline constexpr std::size_t least_runs_to_estimate = 3;

/// Means over the last quarter of a run, or over the period of a steady state.
struct MeanForce {
  double x = 0.0, y = 0.0;                                     ///< of the ground on the body [N/m]
  double friction = std::numeric_limits<double>::quiet_NaN();  ///< dissipated power [W/m]
};

/// Errors of the mean forces predicted by a model, relative to those of the run. @pre own.y > 0
[[nodiscard]] ForceErrors errors_of(const MeanForce& predicted, const MeanForce& own) noexcept;

/// From history.csv; none: the run has no such file or no ground. @throws FileError
[[nodiscard]] std::optional<MeanForce> mean_force_of(const io::RunReader& run);

/// Predicts the case with the modes, with the default step size of `rondo run --reduced`, or less
/// if a contact point would be passed in one step. @pre the case has ground
/// @param run if it is a steady state, whose motion is that of `c`, the modes start from it
[[nodiscard]] MeanForce predicted_force(const Case& c, const rom::ReducedModel& model,
                                        const io::RunReader& run);

}  // namespace rondo::study
