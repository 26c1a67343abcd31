// SPDX-License-Identifier: BSD-3-Clause
/// @file  A snapshot of a run, passed from an analysis to its recorder
/// and from there to the result files. It owns its numbers, so that
/// another thread can write them while the analysis continues.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/fem/solid/solid_stress.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/model/model.hpp"

namespace rondo::io {

/// Force on a candidate in contact.
struct ContactForce {
  std::size_t candidate = 0;  ///< index in mesh.boundary
  /// Components along the normal, J n and, in three dimensions, t2          [N/m], [N]
  Vec3 force;
  Vec3 force_fixed;       ///< the same force along the fixed axes          [N/m], [N]
  bool on_ground = true;  ///< false: only a body touches it
  double slip = 0.0;      ///< tangential velocity over the ground, if the analysis gives it [m/s]
  bool sticks = false;    ///< if the analysis gives it
  double power = 0.0;     ///< that friction takes, if the analysis gives it [W/m], [W]
};

struct Snapshot {
  double time = 0.0;            ///< as in history.csv: [s], or a fraction of the load    [1]
  double time_velocity = 0.0;   ///< of the velocity
  double angle = 0.0;           ///< θ at `time`, counter-clockwise                       [rad]
  double angle_velocity = 0.0;  ///< θ at `time_velocity`                                 [rad]
  Vec3 center;                  ///< of the co-rotating frame: x, y, 0; in space (t1, n, t2)
                                ///< of ground_frame.hpp                                  [m]
  Field u;                      ///< (n) co-rotating frame; of free bodies fixed frame   [m]
  Field v;                      ///< (n) same frame: velocity [m/s], or rate over the load [m]
  std::vector<dynamics::Pose> poses;   ///< (free_bodies)
  std::vector<ContactForce> contacts;  ///< ascending candidates
  std::vector<double> series;          ///< values of the layout's series, one after another
};

/// Additional contents of the result files, computed from a snapshot. Spans are read only during
/// the call that writes it.
struct SnapshotFields {
  /// (nb) sums of ContactForce::force and force_fixed; empty: no contact        [N/m], [N]
  std::span<const Vec3> contact_force, contact_force_fixed;
  /// (nb) length (of a solid mesh area) of the deformed boundary that belongs to each candidate in
  /// contact; empty: undeformed values                                        [m], [m²]
  std::span<const double> contact_extent = {};
  std::span<const fem::Stress> stress = {};  ///< (n) frame of the body; empty: not requested [Pa]
  std::span<const fem::SolidStress> solid_stress = {};  ///< (n) the same for a solid mesh    [Pa]
};

}  // namespace rondo::io
