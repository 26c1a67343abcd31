// SPDX-License-Identifier: BSD-3-Clause
/// @file  How a force or a moment follows a step of the slip over the rolled distance
/// (docs/steady.md, Relaxation lengths).
#pragma once
#include <optional>
#include <span>

namespace rondo::study {

struct Relaxation {
  double before = 0.0, after = 0.0;  ///< in steady rolling before and after the step
  bool changes = false;              ///< by more than round-off; else there are no lengths
  double share = 0.0;                ///< of the change, at the end of the distance            [-]
  std::optional<double> length{};    ///< at which 1 - 1/e of the change is reached; none: not [m]
  /// σ of 1 - e^(-s/σ), by least squares over the distance [m]; none: it is not between a tenth of
  /// the first row and ten times the distance, and the rows do not tell it
  std::optional<double> fitted{};
  std::optional<double> fit_error{};  ///< of this curve, root mean square over the change     [-]
};

/// @param distance rolled since the step, growing, the first 0 [m]. @param force there, the first
/// that before the step. @param after that of steady rolling. @param smallest change that is none
[[nodiscard]] Relaxation relaxation_of(std::span<const double> distance,
                                       std::span<const double> force, double after,
                                       double smallest);

}  // namespace rondo::study
