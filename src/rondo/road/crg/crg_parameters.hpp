// SPDX-License-Identifier: BSD-3-Clause
/// @file  The blocks $ROAD_CRG, $ROAD_CRG_MODS and $ROAD_CRG_OPTS (ASAM OpenCRG 1.2.0,
/// sections 6.4.2, 6.4.5 and 6.4.6): which keys they have, what is done with them and what is
/// refused.
#pragma once
#include <optional>

#include "rondo/road/crg/crg_values.hpp"
#include "rondo/road/road.hpp"

namespace rondo::road {

[[nodiscard]] CrgValues read_road_block(const CrgHeader& header);
/// @throws InputError: also values that are not done or not possible
[[nodiscard]] CrgValues read_modifier_block(const CrgHeader& header);
[[nodiscard]] CrgValues read_option_block(const CrgHeader& header);

/// REFERENCE_LINE_INCREMENT. @throws InputError: none, or out of range
[[nodiscard]] double crg_increment(const CrgValues& road);
/// The number of rows by REFERENCE_LINE_END_U; none without it.
/// @throws InputError: under two rows, or the length is not a whole number of increments
[[nodiscard]] std::optional<double> crg_promised_rows(const CrgValues& road);
/// Slope or banking of the whole line: _START_S or _START_B, 0 without it.
/// @throws InputError: the value at the end is another one
[[nodiscard]] double crg_constant(const CrgValues& road, const char* start_key,
                                  const char* end_key);

/// @throws InputError: a mode that does not exist
[[nodiscard]] Edges crg_edges(const CrgValues& options);

}  // namespace rondo::road
