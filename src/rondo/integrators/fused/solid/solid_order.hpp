// SPDX-License-Identifier: BSD-3-Clause
/// @file  In which order the rows of a sector are walked over: the fewer rows couple across, the
/// nearer steps of a pass follow each other.
#pragma once
#include <vector>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// The sector of a wheel with its rows in the better of two orders: as they are, from the rim
/// outwards, or, where that couples nearer rows of a large wheel, from one side to the other; and
/// where they have been.
struct OrderedSector {
  fem::SolidSector sector;
  std::vector<int> was;  ///< (n_local) row of the model's sector
};

/// @pre model.solid
OrderedSector order_sector(const Model& model);

}  // namespace rondo::dynamics
