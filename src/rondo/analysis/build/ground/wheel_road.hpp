// SPDX-License-Identifier: BSD-3-Clause
/// @file  A measured road under a wheel in three dimensions (docs/roads.md, section 4).
#pragma once
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Makes the smooth surface of the road, with the obstacles on it, the ground of the model, and
/// adds lines about the part that the wheel reaches, and warnings where the wheel leaves the road,
/// where the road has a step at its end and where elements are too long for it. Nothing if the
/// ground is none of a road.
/// @pre motion and contact of the model are set
/// @throws InputError: in this part the road has no height, a slope above 1 or a step at a side
void set_wheel_road(const Case& c, Setup& s);

}  // namespace rondo::study
