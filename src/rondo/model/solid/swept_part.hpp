// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cords and air of a model that are not linear about its state (docs/tyre.md).
#pragma once
#include <span>

#include "rondo/fem/finite/swept_forces.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// @pre model.solid->swept
[[nodiscard]] fem::finite::SweptForces swept_forces(const Model& model);

/// What is stored at u more than in the state, in rubber, cords and air [J].
[[nodiscard]] double stored_energy(const Model& model, std::span<const Vec3> u);

}  // namespace rondo::dynamics
