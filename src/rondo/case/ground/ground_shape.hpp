// SPDX-License-Identifier: BSD-3-Clause
/// @file  The shape of the ground from a profile, or the section of a road, and its obstacles
/// (docs/roads.md, section 4).
#pragma once
#include <string>

#include "rondo/case/case_values.hpp"

namespace rondo::study {

/// Sets GroundCase::shape and edge_angle, or has_own_axes. Faults of obstacles are collected in
/// `in`; with any the shape has none.
/// @pre all keys are read, and the road too
void make_shape(CaseValues& in, Case& c);

/// The key of a fillet with this radius: that of an obstacle, if one has it, else of the ground.
/// @pre there is ground
[[nodiscard]] std::string fillet_key(const Case& c, double radius);

}  // namespace rondo::study
