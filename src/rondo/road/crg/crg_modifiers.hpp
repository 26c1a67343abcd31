// SPDX-License-Identifier: BSD-3-Clause
/// @file  Modifiers of a road ($ROAD_CRG_MODS; ASAM OpenCRG 1.2.0, section 6.4.6).
#pragma once
#include "rondo/road/crg/crg_values.hpp"
#include "rondo/road/road.hpp"

namespace rondo::road {

/// Factors of heights, slopes, lengths; 1 without a modifier.
struct CrgScales {
  double height = 1.0, slope = 1.0, banking = 1.0, length = 1.0, width = 1.0;
};
[[nodiscard]] CrgScales crg_scales(const CrgValues& modifiers);

/// Scales heights, v, banking and increment; the slope is scaled by who integrates it.
void scale_road(const CrgScales& scales, Road& road);

/// Which heights stand for missing ones. Without a block of modifiers, the last valid ones; with a
/// block that says nothing of them, none.
void set_missing(const CrgValues& modifiers, bool has_block, Road& road);

/// Shifts the road so that its reference point has the height REFPOINT_Z, or by REFLINE_OFFSET_Z.
void shift_road(const CrgValues& modifiers, Road& road);

}  // namespace rondo::road
