// SPDX-License-Identifier: BSD-3-Clause
/// @file  Spins at which a wave stands still in the fixed frame (docs/theory.md, 8.6). The response
/// to a constant load, such as the contact with the ground, is then unbounded.
#pragma once
#include <type_traits>
#include <vector>

#include "rondo/modal/modes.hpp"

namespace rondo::modal {

struct CriticalSpeed {
  int diameters = 0;      ///< n
  double spin = 0.0;      ///< lowest |s| with ω = n|s| in the co-rotating frame      [rad/s]
  double residual = 0.0;  ///< ‖A w - s² Q w‖ / ‖A w‖ of (8.6)                        [-]
};

/// One speed for each n = first … last that has any. For n = 1 a free body has none with a meaning,
/// because its translation stands still at every spin.
/// @param stiffening K_σ for unit spin, which is scaled by s² for a spin s; null: none. Rows and
/// columns as those of body.stiffness, which does not hold it.
template <int D>
std::vector<CriticalSpeed> critical_speeds(
    const CyclicBody<D>& body, const std::type_identity_t<fem::SectorBlocks<D>>* stiffening,
    int last);

/// The critical speeds of n = 0 … N/2 at |spin| or below, by one factorisation for each n; for n =
/// 0 it is the spin at which the softening cancels the stiffness. @pre the body is clamped
template <int D>
std::vector<CriticalSpeed> critical_speeds_up_to(const CyclicBody<D>& body, double spin);

}  // namespace rondo::modal
