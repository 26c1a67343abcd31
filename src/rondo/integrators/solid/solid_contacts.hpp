// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contacts of a step of a wheel in three dimensions: every candidate looks for the ground
/// by itself, for none shares a node with another.
#pragma once
#include <vector>

#include "rondo/integrators/solid/solid_forces.hpp"
#include "rondo/model/solid/solid_contact.hpp"

namespace rondo::dynamics {

/// Solves what touches at u_{n+1}. @param v v_{n+1/2}
/// @param next v_{n+3/2} without contact, becomes that with it
/// @param active filled; has room for each candidate twice
ContactReport solve_solid_contacts(const Model& model, const SolidContactStep& step,
                                   std::span<const Vec3> u, std::span<const Vec3> v,
                                   std::span<Vec3> next,
                                   std::vector<ActiveContact>& active) noexcept;

}  // namespace rondo::dynamics
