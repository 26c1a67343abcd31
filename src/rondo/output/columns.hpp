// SPDX-License-Identifier: BSD-3-Clause
/// @file  Columns of history.csv and contact.csv, one row each. Header, values, the units for
/// readers in run.json, and docs/results.md are made from them.
#pragma once
#include <span>

#include "rondo/core/column.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::study {

/// A row of history.csv of any analysis; values that an analysis does not have are 0.
struct HistoryRecord {
  double time = 0.0;   ///< [s], or a fraction of the load                              [1]
  double angle = 0.0;  ///< θ of the co-rotating frame                                   [rad]
  // Vectors in (t1, n, t2) of ground_frame.hpp in three dimensions, else x, y, 0.
  Vec3 center;          ///< [m]
  Vec3 force;           ///< of the ground on the body                               [N/m], [N]
  double torque = 0.0;  ///< of the ground about the center                               [N]
  int nodes = 0, sticking = 0;
  double contact_length = 0.0;  ///< deformed [m]; in three dimensions an area [m²]
  double penetration = 0.0;     ///< [m]
  double slip_ratio = 0.0;      ///< [1]
  dynamics::Balance balance;
  int iterations = 0, extensions = 0;  ///< of massless contact nodes, largest in a step
  dynamics::RimReport rim;             ///< loaded rim only; reactions are means over the interval
  dynamics::MaterialReport material;   ///< rubber only
  // Used in three dimensions only:
  double moment_aligning = 0.0;     ///< about n                                        [N·m]
  double moment_overturning = 0.0;  ///< about t1, on the ground below the center [N·m]
  GroundMoments moments_iso;        ///< about the contact centre of ISO 8855          [N·m]
  double slip_angle = 0.0;          ///< [rad]
  double footprint_length = 0.0, footprint_width = 0.0;  ///< as of mesh::Footprint          [m]
};

/// A row of contact.csv: a node in contact in a snapshot.
struct ContactRecord {
  double time = 0.0;  ///< as in history.csv
  int node = 0;
  double abscissa = 0.0;  ///< along the ground; NaN: in contact with a body           [m]
  Vec3 position;          ///< fixed frame; in three dimensions along (t1, n, t2)         [m]
  Vec3 traction;          ///< pressure, shear along J n, in three dimensions along t2    [Pa]
  double extent = 0.0;    ///< of the deformed boundary that belongs to the node [m], [m²]
  double slip = 0.0;      ///< as in ContactForce                                        [m/s]
  bool sticks = false;    ///< as in ContactForce
  double power = 0.0;     ///< that friction takes, over the extent                    [W/m²]
};

/// The column of the power that friction takes, which analyses add that know velocities.
[[nodiscard]] const Column<ContactRecord>& friction_column() noexcept;

/// Features of a run beyond a plane body whose rim follows its tables. Each adds a group of columns
/// to history.csv.
struct HistoryFeatures {
  bool solid = false;     ///< a wheel in three dimensions: also other units, and an area
  bool rim = false;       ///< a loaded rim
  bool massless = false;  ///< massless contact nodes
  bool rubber = false;
  bool window = false;  ///< of nonlinear rubber
  bool hati = false;    ///< the scheme "hati"
};

/// Columns of history.csv: those of all runs, then the groups in the order of the features.
[[nodiscard]] std::vector<ColumnLabel> history_labels(const HistoryFeatures& features);
/// Appends the values of these columns.
void append_history(const HistoryFeatures& features, const HistoryRecord& record,
                    std::vector<double>& values);

[[nodiscard]] std::span<const Column<ContactRecord>> contact_columns(bool is_solid) noexcept;

}  // namespace rondo::study
