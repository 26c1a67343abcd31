// SPDX-License-Identifier: BSD-3-Clause
/// @file  When a node of a reduced wheel comes to the ground within a step (docs/reduced.md).
#pragma once
#include <algorithm>
#include <cmath>

namespace rondo::rom {

/// Smallest root in [0, 1] of g + b τ + a τ² = 0 with g > 0, a >= 0; 1: there is none.
[[nodiscard]] inline double landing(double g, double b, double a) noexcept {
  if (b >= 0.0) return 1.0;
  const double inside = b * b - 4.0 * a * g;
  if (inside < 0.0) return 1.0;
  return std::min(1.0, 2.0 * g / (-b + std::sqrt(inside)));
}

}  // namespace rondo::rom
