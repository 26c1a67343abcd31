// SPDX-License-Identifier: BSD-3-Clause
/// @file  Ground between the contact nodes of a body: how deep it stands inside straight sides
/// (docs/theory.md, 4.1).
#pragma once
#include "rondo/contact/ground.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::contact {

/// A point of the ground inside a body.
struct Intrusion {
  double depth = 0.0;  ///< behind the body's side, >= 0; 0: there is none              [m]
  Vec2 at;             ///< the ground's point                                          [m]
};

/// The deepest convex bend of the ground behind the side a→b of a body, which is on the left of
/// it: a sharp corner, or the arc's point that the side would meet first. Its foot lies on the
/// side, and it is no deeper than `deepest` [m]. Bends that look the other way (the far side of
/// the ground) do not count. Between two nodes outside the ground nothing else can be inside.
/// Allocates nothing. @pre deepest >= 0
[[nodiscard]] Intrusion deepest_inside(const Ground& ground, Vec2 a, Vec2 b,
                                       double deepest) noexcept;

/// Depths below this share of the spacing of the nodes are as good as none.
inline constexpr double least_hidden = 0.02;

/// The deepest obstacles of the ground in a body whose contact is at its nodes alone.
struct Hidden {
  Intrusion deepest;  ///< between two nodes that both lie on the ground
  /// The deepest obstacle that stands between them as a whole: where they lie the ground runs along
  /// the straight line from one to the other.
  Intrusion whole;
};

/// Looks at places of the first node a sixteenth of the spacing apart. Time in proportion to the
/// surface's length around its bends, over the spacing, and to the points of it in a spacing.
/// @param spacing of neighbouring nodes [m], > 0
[[nodiscard]] Hidden hidden_between_nodes(const Ground& ground, double spacing);

}  // namespace rondo::contact
