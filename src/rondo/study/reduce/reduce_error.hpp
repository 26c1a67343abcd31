// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far off a model's predictions are, from the runs that it is built from: each is left
/// out in turn and predicted (docs/reduced.md, 8b).
#pragma once
#include <functional>
#include <limits>
#include <optional>

#include "rondo/analysis/error_estimate.hpp"
#include "rondo/case/case.hpp"
#include "rondo/io/run_reader.hpp"
#include "rondo/rom/reduced_model.hpp"

namespace rondo::study {

/// Fewer leave a single run to predict another from, which says nothing.
inline constexpr std::size_t least_runs_to_estimate = 3;

/// Means over the last quarter of a run, or over the pass of a steady state.
struct MeanForce {
  double x = 0.0, y = 0.0;                                     ///< of the ground on the body [N/m]
  double friction = std::numeric_limits<double>::quiet_NaN();  ///< power that it takes [W/m]
};

/// Errors of the mean forces that a model predicts, against those of the run itself. @pre own.y > 0
[[nodiscard]] ForceErrors errors_of(const MeanForce& predicted, const MeanForce& own) noexcept;

/// From history.csv; none: the run has none, or no ground. @throws FileError
[[nodiscard]] std::optional<MeanForce> mean_force_of(const io::RunReader& run);

/// Of the case on the modes, in steps of the size `rondo run --reduced` takes by default, or less
/// where a contact point would be passed in one. @pre the case has ground
/// @param run where it is a steady state, of which `c` is the motion, the modes start from it
[[nodiscard]] MeanForce predicted_force(const Case& c, const rom::ReducedModel& model,
                                        const io::RunReader& run);

}  // namespace rondo::study
