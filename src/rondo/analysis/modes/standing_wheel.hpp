// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a wheel in three dimensions touches the ground when it is pressed on it at rest.
#pragma once
#include <span>
#include <vector>

#include "rondo/analysis/modes/modes_solver.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/modal/held_modes.hpp"

namespace rondo::study {

struct StandingWheel {
  Standing figures;
  /// Friction holds a node that touches in all directions; without it the normal alone is held.
  std::vector<modal::HeldDirection<3>> held;
};

/// Pressed down without friction, to motion.height or under analysis.load, with the pressures and
/// the weight of the case. @throws InputError: no flat ground, nothing touches, a rim of free
/// height, a ground within the rim
[[nodiscard]] StandingWheel standing_wheel(const Case& c, const mesh::Mesh& mesh,
                                           std::span<const double> mass,
                                           const fem::SolidSector& sector);

}  // namespace rondo::study
