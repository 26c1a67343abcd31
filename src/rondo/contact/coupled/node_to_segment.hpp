// SPDX-License-Identifier: BSD-3-Clause
/// @file  Relative velocity of a point and a segment of a body's boundary, as rows on the
/// velocities of the point and of the segment's two nodes (docs/theory.md, 4.8).
/// The segment's body is on the left of a→b; n points out of it, to the right; t = J n is along
/// a→b. w = (w_n, w_t) of the point against the segment as if rigid: w_n > 0 separates.
#pragma once
#include "rondo/contact/coupled/rows.hpp"
#include "rondo/contact/segment.hpp"

namespace rondo::contact {

/// H_p, H_a, H_b: w = H_p v_p + H_a v_a + H_b v_b, fixed frame (4.8b). w = 0 for every rigid motion
/// of the three points, so the impulses Hᵀr, r acting on the point, have no resultant and no
/// moment.
struct SegmentRows {
  Block point, a, b;
};

/// @param length of the segment now [m]
SegmentRows segment_rows(const SegmentTouch& touch, double length) noexcept;

/// A node p against the segment of nodes a, b.
ContactRows node_rows(const SegmentTouch& touch, double length, int p, int a, int b) noexcept;

/// A point that does not move (a corner of the ground) against the segment of nodes a, b: r is the
/// impulse on the ground.
ContactRows corner_rows(const SegmentTouch& touch, double length, int a, int b) noexcept;

}  // namespace rondo::contact
