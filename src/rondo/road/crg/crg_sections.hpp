// SPDX-License-Identifier: BSD-3-Clause
/// @file  Positions of the long sections across the road.
#pragma once
#include <cstddef>
#include <vector>

#include "rondo/road/crg/crg_channels.hpp"
#include "rondo/road/crg/crg_values.hpp"

namespace rondo::road {

struct CrgSections {
  std::vector<double> v;             ///< (n_v) ascending, from right to left              [m]
  std::vector<std::size_t> channel;  ///< (n_v) column of the data of each
};

/// From the positions in the channels, or from their numbers and LONG_SECTION_V_RIGHT, _LEFT,
/// _INCREMENT of $ROAD_CRG. Without right and left the sections lie symmetrically to the line.
/// @throws InputError: under two sections, both forms, numbers that are not 1 ... n, positions
/// closer than 1e-6 m, or others than the right, left and increment say
[[nodiscard]] CrgSections crg_sections(const CrgDefinition& definition, const CrgValues& road);

}  // namespace rondo::road
