// SPDX-License-Identifier: BSD-3-Clause
/// @file  The rows H that take displacements and velocities of the nodes to those of the contact
/// candidates on the ground, with normals and gaps (docs/operators.md).
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/matrices/operators.hpp"
#include "rondo/core/field.hpp"

namespace rondo::study {

/// Where the co-rotating frame is.
struct FramePlace {
  double angle = 0.0;  ///< θ, counter-clockwise                                        [rad]
  Vec3 center;         ///< in the plane x, y; in space along t1, n, t2 of the ground   [m]
};

/// By the tables of the motion. @param option that gave the time, for the message
/// @throws InputError: the time is < 0 or not finite; a rim that forces move, after the start
[[nodiscard]] FramePlace frame_at(const dynamics::Model& model, double time,
                                  const std::string& option);

/// Rows of all nb candidates, also of those that do not touch: each takes the nearest facet of the
/// ground for an endless plane.
struct ContactRows {
  /// H (components·nb, unknowns): of candidate k the rows components·k + (0: normal n, 1: tangent
  /// J n, 2: lateral t2), in the co-rotating frame
  Csr rows;
  std::vector<double> normal;             ///< (nb, components) out of the ground, fixed frame
  std::vector<double> normal_corotating;  ///< (nb, components) the same, co-rotating frame
  std::vector<double> gap;                ///< (nb) signed distance, > 0 outside               [m]
};

/// @param u (n) displacement of all nodes, co-rotating frame; empty: 0                       [m]
/// @throws InputError: no ground. @pre the nodes are held, as for make_operators()
[[nodiscard]] ContactRows contact_rows(const Case& c, const dynamics::Model& model,
                                       const FramePlace& frame, FieldView u);

}  // namespace rondo::study
