// SPDX-License-Identifier: BSD-3-Clause
/// @file  The ground from a measured road: under a plane body the section of the road at one v,
/// under a wheel in three dimensions its smooth surface (docs/roads.md, sections 3 and 4).
#pragma once
#include "rondo/case/case_values.hpp"
#include "rondo/road/road.hpp"

namespace rondo::study {

/// Reads ground.road. For a plane body it makes the points of the ground: x is u - road_start, and
/// y is the height without that at x = 0. For a wheel in three dimensions the points stay those of
/// flat ground, and the road is kept. Faults of the keys and of the file are collected in `in`.
/// @pre all keys are read
void take_road(CaseValues& in, Case& c);

/// The borders of the road as the case asks for them. @pre a road is read
[[nodiscard]] road::Edges edges_of(const RoadCase& road);

}  // namespace rondo::study
