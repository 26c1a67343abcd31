// SPDX-License-Identifier: BSD-3-Clause
/// @file  What tells a late contact: a point that was behind a segment in the step before, and was
/// found behind none then.
#pragma once
#include <array>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/integrators/general/contact_row.hpp"

namespace rondo::dynamics {

/// The corner, or the node, of this key was found behind some segment.
/// @param before contacts of the step before
[[nodiscard]] bool was_found(const contact::KeptImpulses& before, std::uint64_t key) noexcept;

/// The point may have come in beside the segment a→b, at an end without a neighbour.
/// @param along velocity of the point along the segment, times Δt [m]
/// @param beside edges before and after the segment, -1: there is none
[[nodiscard]] bool came_round_an_end(Vec2 point, Vec2 a, Vec2 b, double along,
                                     const std::array<int, 2>& beside) noexcept;

}  // namespace rondo::dynamics
