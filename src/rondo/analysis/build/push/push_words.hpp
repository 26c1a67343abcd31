// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo check` tells in words to which side and along which way the ground will push a
/// wheel, because signs of slip angles and cambers differ between systems (docs/conventions.md).
#pragma once
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// A line for each key that pushes the wheel: slip angle, camber, turn slip, torque, brake,
/// traction, slip ratio. None for bodies that do not roll on a ground.
[[nodiscard]] std::vector<Told> push_lines(const Case& c, const mesh::Mesh& mesh);

}  // namespace rondo::study
