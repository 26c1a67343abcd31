// SPDX-License-Identifier: BSD-3-Clause
/// @file  Depths and heights at which a body that does not turn bears a given load: the crush
/// solver (docs/theory.md, 6.4) inverted by a secant search.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondo/analysis/build/crush_setup.hpp"
#include "rondo/case/case.hpp"

namespace rondo::study {

/// What the ground's force is to agree to, relative to it.
inline constexpr double target_tolerance = 1e-6;
/// Increments of each crush of the search for a dynamic case: with friction the force hangs on the
/// path.
inline constexpr int target_increments = 20;

struct TargetFound {
  double force = 0.0;   ///< asked for [N/m]
  double depth = 0.0;   ///< below first touch [m]; 0: none
  double height = 0.0;  ///< of the center above y = 0 [m]
  int crushes = 0;      ///< that were solved for it
  std::string trouble;  ///< why there is none; empty: found
};

/// Settings that make a crush on flat ground of a case. @param depth that the search may go to [m]
/// @param increments of the case, if it is a crush; 0: target_increments
[[nodiscard]] std::vector<std::string> crush_settings(double depth, int increments);

/// @param c a crush on flat ground, whose depth is the largest that is tried
/// @param forces each > 0 [N/m]
[[nodiscard]] std::vector<TargetFound> find_depths(const Case& c, std::span<const double> forces);

}  // namespace rondo::study
