// SPDX-License-Identifier: BSD-3-Clause
/// @file  Spins at which a wave stands still in the fixed frame (docs/theory.md, 8.6): a constant
/// load, such as the contact with the ground, then meets no resistance.
#pragma once
#include <vector>

#include "rondo/modal/modes.hpp"

namespace rondo::modal {

struct CriticalSpeed {
  int diameters = 0;      ///< n
  double spin = 0.0;      ///< lowest |s| with ω = n|s| in the turning frame          [rad/s]
  double residual = 0.0;  ///< ‖A w - s² Q w‖ / ‖A w‖ of (8.6)                        [-]
};

/// One for each n = first … last that has any; n = 1 of a free body has none that means anything:
/// its translation stands still at every spin.
/// @param stiffening K_σ of a unit spin: that of a spin s is s² as large; null: none. Rows and
/// columns as those of body.stiffness, which does not hold it.
std::vector<CriticalSpeed> critical_speeds(const CyclicBody& body,
                                           const fem::SectorStiffness* stiffening, int last);

/// Those of n = 0 … N/2 that are at |spin| or below, by a factorisation for each n; n = 0 is the
/// spin that softens the body to nothing. @pre the body is clamped
std::vector<CriticalSpeed> critical_speeds_up_to(const CyclicBody& body, double spin);

}  // namespace rondo::modal
