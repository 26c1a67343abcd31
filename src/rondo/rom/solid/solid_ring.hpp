// SPDX-License-Identifier: BSD-3-Clause
/// @file  The harmonics of a wheel of N equal sectors in three dimensions whose contact nodes have
/// no mass (docs/reduced.md): what wheel/ring_harmonics.hpp has of a disk, with a third component,
/// along the axle. Matrices of a harmonic are sparse here, because a section has many nodes.
#pragma once
#include <vector>

#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

/// The harmonics that have modes, ascending; as ring_modes().
/// @throws std::bad_alloc
[[nodiscard]] std::vector<RingHarmonic> solid_modes(const SolidRing& ring,
                                                    const ModeChoice& choice);

}  // namespace rondo::rom
