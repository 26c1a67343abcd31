// SPDX-License-Identifier: BSD-3-Clause
/// @file  Obstacles of several angles, or on a road, under a wheel in three dimensions
/// (docs/roads.md, section 5).
#pragma once
#include <memory>

#include "rondo/case/setup.hpp"
#include "rondo/contact/space/base_ground.hpp"

namespace rondo::study {

/// The ground with the obstacles of the case on it; the base itself if there are none. On ground
/// that is not level, adds a warning of fillets that are smaller than the nodes are apart.
/// @pre motion and contact of the model are set
/// @throws InputError: obstacles of different angles overlap where the wheel comes
[[nodiscard]] std::shared_ptr<const contact::SpaceGround> obstacles_on(
    const Case& c, std::shared_ptr<const contact::BaseGround> base, Setup& s);

/// Makes a profile with such obstacles the ground of the model; nothing without these, or on a
/// road. @pre, @throws as obstacles_on()
void set_wheel_obstacles(const Case& c, Setup& s);

}  // namespace rondo::study
