// SPDX-License-Identifier: BSD-3-Clause
/// @file  The columns of the data, collected row by row, and what they must hold.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "rondo/road/crg/crg_channels.hpp"
#include "rondo/road/crg/crg_sections.hpp"

namespace rondo::road {

/// Columns that the file does not have are empty.
struct CrgColumns {
  std::vector<double> heights;                            ///< (n_u, n_v), NaN where missing [m]
  std::vector<double> heading, banking, slope, position;  ///< (n_u) [rad], [-], [-], [m]
};

/// Adds one row of the data. @param row (n_channels)
void add_crg_row(const CrgDefinition& definition, const CrgSections& sections,
                 std::span<const double> row, CrgColumns& columns);

/// Heights may be missing at the edges of a row, nowhere else; slopes and banking may not.
/// @throws FileError: the row and what is wrong
void demand_sound_columns(const CrgColumns& columns, const CrgSections& sections,
                          const std::string& file);

}  // namespace rondo::road
