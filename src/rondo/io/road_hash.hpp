// SPDX-License-Identifier: BSD-3-Clause
/// @file  A hash of what of a road is the ground: a run goes on only on the same road.
#pragma once
#include <string>

#include "rondo/road/road.hpp"

namespace rondo::io {

/// Hash of the heights with all that is added to them, of where they are, and of the borders. The
/// name of the file does not matter.
[[nodiscard]] std::string road_hash(const road::Road& road);

}  // namespace rondo::io
