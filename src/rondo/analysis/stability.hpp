// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a run would leave stability, or the model its meaning: warned of or refused with
/// the figures (docs/cases.md, "What is warned of"; measured in docs/reliability.md).
#pragma once
#include "rondo/analysis/build.hpp"

namespace rondo::study {

/// From this share of the critical step on, contact may feed the shortest waves of an undamped
/// body.
inline constexpr double contact_step_share = 0.985;
/// Damping ratio β ω_max / 2 that keeps them down.
inline constexpr double contact_damping_ratio = 0.005;
/// Growth, as a power of e over the run, above which it is spoken of.
inline constexpr double growth_spoken_of = 10.0;
/// Largest turn of a free body in a step [rad].
inline constexpr double largest_turn = 0.3;

/// Adds warnings. @throws InputError: a free body that turns by more than largest_turn in a step.
/// @pre all else of the setup is there
void check_stability(const Case& c, Setup& s);

/// @throws InputError: motion, or the flight of free bodies, brings the body so far from the origin
/// that its elements are lost in the rounding of coordinates. @param mesh as generated or read
void check_places(const Case& c, const mesh::Mesh& mesh);

}  // namespace rondo::study
