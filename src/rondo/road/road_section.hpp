// SPDX-License-Identifier: BSD-3-Clause
/// @file  The section of a road along u, for bodies in a plane. At one v the bilinear height is
/// linear between two rows of the grid, so that a polyline through the rows is the section itself
/// (docs/roads.md, section 3).
#pragma once
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/road/road_part.hpp"
#include "rondo/road/surface.hpp"

namespace rondo::road {

/// (n_u) points (u, height) [m], one for each row of the grid; the height is not a number where the
/// road has none. @pre v is on the grid
[[nodiscard]] std::vector<Vec2> section_of(const Surface& surface, double v);

/// Height of a section at u, linear between its points [m]. @pre two points or more, u between the
/// first and the last of them
[[nodiscard]] double height_in(std::span<const Vec2> section, double u) noexcept;

/// The section with a level stretch before its first point and one behind its last point, at the
/// heights that the border along u gives; a step of more than 1e-9 m leads to them.
/// @pre the section is section_of(surface, v); the border along u is keep or zero
[[nodiscard]] std::vector<Vec2> with_level_ends(std::span<const Vec2> section,
                                                const Surface& surface, double v);

/// The largest change of slope between two stretches of a section whose middles are at most
/// `length` apart: what changes the slope so much within an element passes between its nodes. u is
/// the end of the first of the two stretches; only stretches within the part count, and no
/// vertical steps. @param length > 0 [m]
[[nodiscard]] RoadPlace largest_bend(std::span<const Vec2> section, double length,
                                     const RoadPart& part = {}) noexcept;

}  // namespace rondo::road
