// SPDX-License-Identifier: BSD-3-Clause
/// @file  Corners, arcs and facets of the ground that stand inside the cells of a body at the
/// start, between its nodes.
#pragma once
#include <span>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// A point of the ground in a cell.
struct GroundInside {
  double depth = 0.0;  ///< distance from the side that may touch; 0: no such point [m]
  double size = 1.0;   ///< size of the elements at that side [m]
  Vec2 place;          ///< [m]
  int node = -1;       ///< node of that side
};

/// The one that is deepest over the size of its elements. Of the surface its corners are looked at
/// and points a quarter of an element apart. Points that are nearer to another side of the body
/// than to one that may touch do not count.
/// @param x (n) places of the nodes, fixed frame [m] @param size (n) of element_sizes() [m]
/// @pre the model is plane and has contact
GroundInside find_ground_inside(const Setup& s, std::span<const Vec2> x,
                                std::span<const double> size);

}  // namespace rondo::study
