// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where the power of steady rolling in three dimensions goes, as in the plane
/// (steady/rolling_power.hpp): an identity to round-off.
#pragma once
#include "rondo/statics/steady/rolling_power.hpp"
#include "rondo/statics/steady_solid/solid_contact.hpp"

namespace rondo::statics {

/// U_k of all rows under the solution's forces [m].
[[nodiscard]] SolidHarmonics::Block spectrum_of(const SolidWindow& window,
                                                const SolidRollingSolution& solution);

/// In W. `drive` is V·F + s T, of the ground's forces.
[[nodiscard]] RollingPower rolling_power(const SolidWindow& window,
                                         const SolidRollingSolution& solution,
                                         const SolidHarmonics::Block& spectrum);

}  // namespace rondo::statics
