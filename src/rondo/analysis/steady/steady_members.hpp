// SPDX-License-Identifier: BSD-3-Clause
/// @file  What steady rolling has in run.json, besides shared_members().
#pragma once
#include "rondo/analysis/steady/steady_state.hpp"

namespace rondo::study {

/// @param harmonics_s, solve_s wall times [s]
void describe_steady(double harmonics_s, double solve_s, Json& json);

/// A state in the plane, where all is per metre of width, or in space.
struct SteadyFigures {
  const Case& c;
  const statics::RollingSolution& s;
  const SteadySums& mean;
  const statics::RollingPower& power;
  const std::vector<std::string>& parts;  ///< names of the viscous parts
  const std::optional<SlipError>& slip_error;
  double height, slip_ratio, resistance;  ///< [m], [1], [N]
  std::size_t pairs;
  bool solid;
  const statics::FiniteEffort* finite;  ///< null: the forces are linear
};
void add_steady(const SteadyFigures& figures, Json& json);

}  // namespace rondo::study
