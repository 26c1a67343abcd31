// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/stability/friction_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rondo::dynamics {

double friction_limit(const ElementLimit& elements, double dt) noexcept {
  const double turn = elements.omega * dt;
  const double share = 0.25 * turn * turn +
                       0.5 * elements.stiffness_damping * elements.omega * turn +
                       0.5 * elements.mass_damping * dt;
  return std::max(0.0, 2.0 * (1.0 - share));
}

/// The positive root of ½ω² Δt² + (βω² + α + rate) Δt = 2.
double friction_step(const ElementLimit& elements, double rate) noexcept {
  const double square = 0.5 * elements.omega * elements.omega;
  const double linear = 2.0 * elements.stiffness_damping * square + elements.mass_damping + rate;
  if (square == 0.0 && linear == 0.0) return std::numeric_limits<double>::infinity();
  return 4.0 / (linear + std::sqrt(linear * linear + 8.0 * square));
}

}  // namespace rondo::dynamics
