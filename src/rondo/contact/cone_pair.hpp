// SPDX-License-Identifier: BSD-3-Clause
/// @file  A node held by two facets of a ground that is extruded along their common line, with two
/// tangential directions: what pair.hpp is in the plane, by the same cases (docs/wheel3d.md).
#pragma once
#include <array>

#include "rondo/contact/cone.hpp"

namespace rondo::contact {

/// Unknowns are two impulses, each in its own contact frame: normal, tangent, line of the corner.
struct SpatialPair {
  Vec3 free;                       ///< relative velocity without impulses, frame 0     [m/s]
  std::array<Vec3, 3> delassus{};  ///< rows of W of the node, frame 0                 [1/kg]
  std::array<double, 2> bounce{};  ///< ε of each contact, see SpatialProblem           [m/s]
  Complex turn;                    ///< takes frame 1 to frame 0; not ±1
};

struct SpatialPairSolution {
  std::array<SpatialSolution, 2> contact;
  double residual = 0.0;   ///< law residual of the worse one over m |free|
  bool converged = false;  ///< residual <= tolerance
};

/// The cases in turn: both open, one alone, both pressing. With both pressing, two normal
/// velocities are known, so the velocity is but for its part along the corner: none where the node
/// sticks, else a number that is found by halving. The first case that the law's residual accepts
/// is taken; else the one with the smallest residual.
[[nodiscard]] SpatialPairSolution solve_spatial_pair(const SpatialPair& problem, double friction,
                                                     double tolerance = 1e-12) noexcept;

}  // namespace rondo::contact
