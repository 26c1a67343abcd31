// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a crush writes of an increment: its row of history.csv and its snapshot.
#pragma once
#include <vector>

#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/mesh/deformed_boundary.hpp"
#include "rondo/output/recorder.hpp"

namespace rondo::study {

/// Sums over the contact after an increment.
struct CrushSums {
  Vec2 contact;         ///< force of the ground: normal, tangential [N/m]
  Vec2 force;           ///< this force along the fixed axes [N/m]
  double torque = 0.0;  ///< about the center [N]
  int nodes = 0, sticking = 0;
  double length = 0.0;                 ///< [m]
  double pressure = 0.0, shear = 0.0;  ///< largest [Pa]
};

/// @param boundary of setup.mesh: length and tractions are those of the deformed boundary
CrushSums sum_up(const CrushSetup& setup, const mesh::DeformedBoundary& boundary,
                 const statics::CrushState& state);

/// Increment k; 0: first touch.
struct CrushRecord {
  int k = 0;
  const statics::CrushState& state;
  const statics::CrushReport& report;
  const CrushSums& sums;
};

/// Labels of a row: those of every analysis, then those of a crush.
std::vector<ColumnLabel> crush_columns();
/// @param rows of history.csv, one after another
void append_row(const CrushSetup& setup, const CrushRecord& r, std::vector<double>& rows);

io::ResultsWords crush_words(const CrushPath& path);
/// The curve of force over depth, a value for each snapshot.
std::vector<io::Series> crush_series();
/// @param before (n) displacement one increment earlier [m]
void fill(const CrushSetup& setup, const CrushRecord& r, const std::vector<Vec2>& before,
          Snapshot& snapshot);

}  // namespace rondo::study
