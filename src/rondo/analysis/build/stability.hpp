// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a run would leave stability, or the model its meaning: warned of or refused with
/// the figures (docs/cases.md, "What is warned of"; measured in docs/reliability.md).
#pragma once
#include "rondo/analysis/build/build.hpp"
#include "rondo/model/loaded_rim.hpp"

namespace rondo::study {

/// From this share of the critical step on, contact may feed the shortest waves of an undamped
/// body.
inline constexpr double contact_step_share = 0.985;
/// Damping ratio β ω_max / 2 that keeps them down.
inline constexpr double contact_damping_ratio = 0.005;
/// Growth, as a power of e over the run, above which it is spoken of.
inline constexpr double growth_spoken_of = 10.0;
/// Largest turn of a free body, or of a rim of its own, in a step [rad].
inline constexpr double largest_turn = dynamics::most_turn;

/// Above this size the check of spin softening, a Cholesky factorisation, is left out...
inline constexpr std::size_t softening_check_dofs = 500000;
/// ... unless the body falls apart into harmonics of this size at the most.
inline constexpr std::size_t softening_check_harmonic_dofs = 20000;

/// Whether the check is made. `harmonic_dofs`: as many as a sector has; 0: not by harmonics.
bool softening_is_checked(std::size_t dofs, std::size_t harmonic_dofs) noexcept;

/// Adds warnings. @throws InputError: a free body, or a rim of its own, that turns by more than
/// largest_turn in a step.
/// @pre all else of the setup is there
void check_stability(const Case& c, Setup& s);

/// Checks the motion of the rim alone, and what of a step depends on it. @throws InputError
void check_motion(const Case& c, const Setup& s);
/// Adds a warning where the largest spin is beyond the softening limit, or near it.
void warn_of_softening(const Case& c, Setup& s);

/// @throws InputError: motion, or the flight of free bodies, brings the body so far from the origin
/// that its elements are lost in the rounding of coordinates. @param mesh as generated or read
void check_places(const Case& c, const mesh::Mesh& mesh);

}  // namespace rondo::study
