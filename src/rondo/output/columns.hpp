// SPDX-License-Identifier: BSD-3-Clause
/// @file  Columns of history.csv and contact.csv: one row each, from which header, values, run.json
/// (where readers find units) and docs/results.md follow.
#pragma once
#include <span>

#include "rondo/core/column.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::study {

/// A row of history.csv, of any analysis; what an analysis has not is 0.
struct HistoryRecord {
  double time = 0.0;   ///< [s], or a share of the load                                  [1]
  double angle = 0.0;  ///< θ of the turning frame                                       [rad]
  // In three dimensions (t1, n, t2) of ground_frame.hpp, else x, y, 0.
  Vec3 center;          ///< [m]
  Vec3 force;           ///< of the ground on the body                               [N/m], [N]
  double torque = 0.0;  ///< of the ground about the center                               [N]
  int nodes = 0, sticking = 0;
  double contact_length = 0.0;  ///< deformed [m]; in three dimensions an area [m²]
  double penetration = 0.0;     ///< [m]
  double slip_ratio = 0.0;      ///< [1]
  dynamics::Balance balance;
  int iterations = 0, extensions = 0;  ///< of contact nodes without mass, most in a step
  dynamics::RimReport rim;            ///< of a loaded rim; what holds it as means over the interval
  dynamics::MaterialReport material;  ///< of rubber
  // In three dimensions:
  double moment_aligning = 0.0;     ///< about n                                        [N·m]
  double moment_overturning = 0.0;  ///< about t1, in the ground under the center        [N·m]
  double slip_angle = 0.0;          ///< [rad]
};

/// A row of contact.csv: a node in contact in a snapshot.
struct ContactRecord {
  double time = 0.0;  ///< as in history.csv
  int node = 0;
  double abscissa = 0.0;  ///< along the ground; NaN: pressed against a body             [m]
  Vec3 position;          ///< fixed frame; in three dimensions along (t1, n, t2)         [m]
  Vec3 traction;          ///< pressure, shear along J n, in three dimensions along t2    [Pa]
  double extent = 0.0;    ///< of the deformed boundary that the node stands for   [m], [m²]
  double slip = 0.0;      ///< as in ContactForce                                        [m/s]
  bool sticks = false;    ///< as in ContactForce
};

/// What a run has besides a plane body whose rim follows tables. Each gives history.csv a group of
/// columns.
struct HistoryFeatures {
  bool solid = false;     ///< a wheel in three dimensions: also other units, and an area
  bool rim = false;       ///< a loaded rim
  bool massless = false;  ///< contact nodes without mass
  bool rubber = false;
  bool hati = false;  ///< the scheme
};

/// Columns of history.csv: those that every run has, then the groups in the order of the features.
[[nodiscard]] std::vector<ColumnLabel> history_labels(const HistoryFeatures& features);
/// Adds the values of these columns.
void append_history(const HistoryFeatures& features, const HistoryRecord& record,
                    std::vector<double>& values);

[[nodiscard]] std::span<const Column<ContactRecord>> contact_columns(bool is_solid) noexcept;

}  // namespace rondo::study
