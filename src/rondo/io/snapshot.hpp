// SPDX-License-Identifier: BSD-3-Clause
/// @file  A snapshot of a run: what an analysis hands to its recorder and the recorder to the
/// result files. It owns its numbers, so that another thread may write them while the analysis goes
/// on.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/fem/solid/solid_stress.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/model/model.hpp"

namespace rondo::io {

/// Force on a candidate that is pressed.
struct ContactForce {
  std::size_t candidate = 0;  ///< index in mesh.boundary
  /// Along the normal, along J n and, in three dimensions, along t2         [N/m], [N]
  Vec3 force;
  Vec3 force_fixed;       ///< the same force along the fixed axes          [N/m], [N]
  bool on_ground = true;  ///< false: only a body presses it
  double slip = 0.0;      ///< velocity over the ground, along it; where the analysis has it [m/s]
  bool sticks = false;    ///< where the analysis tells it
};

struct Snapshot {
  double time = 0.0;            ///< as in history.csv: [s], or a share of the load       [1]
  double time_velocity = 0.0;   ///< of the velocity
  double angle = 0.0;           ///< θ at `time`, counter-clockwise                       [rad]
  double angle_velocity = 0.0;  ///< θ at `time_velocity`                                 [rad]
  Vec3 center;                  ///< of the turning frame: x, y, 0; in three dimensions (t1, n, t2)
                                ///< of ground_frame.hpp                                  [m]
  Field u;                      ///< (n) turning frame; of free bodies fixed frame        [m]
  Field v;                      ///< (n) same frame: velocity [m/s], or rate over the load [m]
  std::vector<dynamics::Pose> poses;   ///< (free_bodies)
  std::vector<ContactForce> contacts;  ///< ascending candidates
  std::vector<double> series;          ///< values of the layout's series, one after another
};

/// What the result files have besides, computed from a snapshot. Spans are only read during the
/// call that writes it.
struct SnapshotFields {
  /// (nb) sums of ContactForce::force and force_fixed; empty: no contact        [N/m], [N]
  std::span<const Vec3> contact_force, contact_force_fixed;
  /// (nb) length, of a solid mesh area, of the deformed boundary that each candidate stands for,
  /// where it is pressed; empty: as it is undeformed                            [m], [m²]
  std::span<const double> contact_extent = {};
  std::span<const fem::Stress> stress = {};  ///< (n) frame of the body; empty: not asked for [Pa]
  std::span<const fem::SolidStress> solid_stress = {};  ///< the same of a solid mesh         [Pa]
};

}  // namespace rondo::io
