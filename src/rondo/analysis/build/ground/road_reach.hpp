// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a body comes on a road, and what it meets where it leaves it.
#pragma once
#include <limits>
#include <string>

#include "rondo/case/case.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::study {

/// Places along a line [m]; by default none.
struct Stretch {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();

  void include(double low, double high) noexcept;
};

/// Where the body touches the ground at most along x, if its center follows the tables of [motion]:
/// the speed of a rim that forces move counts with its value at t = 0. Everywhere for free bodies.
[[nodiscard]] Stretch reach_along(const Case& c, const mesh::Mesh& mesh);

/// Where a wheel in three dimensions touches the ground at most along t2, which it follows by the
/// tables of [motion]: its width where it is within 45 degrees of the ground, and a twentieth of
/// its radius on either side for its deformation. @pre mesh.is_solid()
[[nodiscard]] Stretch reach_across(const Case& c, const mesh::Mesh& mesh);

/// "the ground is level at the heights of its ends": what is before and behind the road.
[[nodiscard]] std::string beyond_text(const RoadCase& road);

/// A warning if the body leaves the road; empty if it stays on it, if it is not known where it
/// goes, or if the road goes on. @param on_road x of its ends [m]
[[nodiscard]] std::string leaving_text(const RoadCase& road, const Stretch& reach,
                                       const Stretch& on_road);

}  // namespace rondo::study
