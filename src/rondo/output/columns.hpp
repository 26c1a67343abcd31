// SPDX-License-Identifier: BSD-3-Clause
/// @file  Columns of history.csv and contact.csv: one row each, from which header, values, run.json
/// (where readers find units) and docs/results.md follow.
#pragma once
#include <span>

#include "rondo/core/column.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::study {

/// A row of history.csv, of any analysis; what an analysis has not is 0.
struct HistoryRecord {
  double time = 0.0;    ///< [s], or a share of the load                                  [1]
  double angle = 0.0;   ///< θ of the turning frame                                       [rad]
  Vec2 center;          ///< [m]
  Vec2 force;           ///< of the ground on the body                                    [N/m]
  double torque = 0.0;  ///< of the ground about the center                               [N]
  int nodes = 0, sticking = 0;
  double contact_length = 0.0;  ///< deformed [m]; in three dimensions an area [m²]
  double penetration = 0.0;     ///< [m]
  double slip_ratio = 0.0;      ///< [1]
  dynamics::Balance balance;
  int iterations = 0, extensions = 0;  ///< of contact nodes without mass, most in a step
  dynamics::RimReport rim;            ///< of a loaded rim; what holds it as means over the interval
  dynamics::MaterialReport material;  ///< of rubber
  // In three dimensions, where `center` and `force` are along t1 and n, in N and N·m.
  double lateral = 0.0;             ///< of the center along t2                           [m]
  double force_lateral = 0.0;       ///< along t2                                         [N]
  double moment_aligning = 0.0;     ///< about n                                        [N·m]
  double moment_overturning = 0.0;  ///< about t1, in the ground under the center        [N·m]
  double slip_angle = 0.0;          ///< [rad]
};

/// A row of contact.csv: a node in contact in a snapshot.
struct ContactRecord {
  double time = 0.0;  ///< as in history.csv
  int node = 0;
  double abscissa = 0.0;  ///< along the ground; NaN: pressed against a body             [m]
  Vec2 position;          ///< fixed frame                                                [m]
  Vec2 traction;          ///< pressure, shear                                            [Pa]
  double extent = 0.0;    ///< of the deformed boundary that the node stands for   [m], [m²]
  double slip = 0.0;      ///< as in ContactForce                                        [m/s]
  bool sticks = false;    ///< likewise
  double lateral = 0.0;   ///< in three dimensions: of the place along t2; `position` is along t1
                          ///< and n                                                       [m]
  double shear_lateral = 0.0;  ///< in three dimensions: along t2                         [Pa]
};

[[nodiscard]] std::span<const Column<HistoryRecord>> history_columns() noexcept;
/// The same of a wheel in three dimensions: with its units, and an area for the length.
[[nodiscard]] std::vector<ColumnLabel> history_labels(bool is_solid);
[[nodiscard]] std::vector<ColumnLabel> rim_labels(bool is_solid);
/// Those that a wheel in three dimensions has besides.
[[nodiscard]] std::span<const Column<HistoryRecord>> solid_columns() noexcept;
/// Those that a run with a loaded rim has besides.
[[nodiscard]] std::span<const Column<HistoryRecord>> rim_columns() noexcept;
/// Behind those, where contact nodes have no mass.
[[nodiscard]] std::span<const Column<HistoryRecord>> massless_columns() noexcept;
/// Where some part is rubber.
[[nodiscard]] std::span<const Column<HistoryRecord>> rubber_columns() noexcept;
/// Those of the scheme "hati".
[[nodiscard]] std::span<const Column<HistoryRecord>> hati_columns() noexcept;
[[nodiscard]] std::span<const Column<ContactRecord>> contact_columns() noexcept;
/// Of a wheel in three dimensions, instead.
[[nodiscard]] std::span<const Column<ContactRecord>> solid_contact_columns() noexcept;

}  // namespace rondo::study
