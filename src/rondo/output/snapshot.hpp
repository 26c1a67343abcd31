// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a snapshot is made of, as an analysis hands it to its recorder: plain numbers, so
/// that another thread may write them while the analysis goes on.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::study {

/// Of a candidate that is pressed.
struct ContactForce {
  std::size_t candidate = 0;  ///< place in mesh.boundary
  Vec2 force;                 ///< normal, tangential              [N/m], in three dimensions [N]
  Vec2 force_fixed;           ///< the same, fixed frame           [N/m], in three dimensions [N]
  bool on_ground = true;      ///< false: only a body presses it
  double slip = 0.0;     ///< velocity over the ground, along it; where the analysis has it [m/s]
  bool sticks = false;   ///< likewise
  double lateral = 0.0;  ///< in three dimensions: of the force along t2               [N]
  double fixed_axial = 0.0;  ///< in three dimensions: of the force along the axle         [N]
};

struct Snapshot {
  double time = 0.0;            ///< as in history.csv: [s], or a share of the load       [1]
  double time_velocity = 0.0;   ///< of the velocity
  double angle = 0.0;           ///< θ at `time`                                          [rad]
  double angle_velocity = 0.0;  ///< θ at `time_velocity`                                 [rad]
  Vec2 center;                  ///< of the turning frame; in three dimensions along t1, n [m]
  double lateral = 0.0;         ///< in three dimensions: of the center along t2           [m]
  std::vector<Vec2> u;          ///< (n) turning frame; of free bodies fixed frame        [m]
  std::vector<Vec2> v;          ///< (n) likewise: velocity [m/s], or rate over the load  [m]
  std::vector<double> axial_u,
      axial_v;                         ///< (n) in three dimensions, else empty          [m], [m/s]
  std::vector<dynamics::Pose> poses;   ///< (free_bodies)
  std::vector<ContactForce> contacts;  ///< ascending candidates
  std::vector<double> series;          ///< values of the plan's series, one after another
};

/// Fills and returns `snapshot` from a state of a motion: fields, contacts, place of the frame. Of
/// a loaded rim the angle at the velocity's time is the mean of those at both ends of the step.
Snapshot& fill_snapshot(const Setup& setup, const dynamics::State& state, Snapshot& snapshot);

}  // namespace rondo::study
