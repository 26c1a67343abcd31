// SPDX-License-Identifier: BSD-3-Clause
/// @file  What is held and reaches the ground: the ground does nothing to it, and the run would say
/// that all forces are 0. Mostly mesh.clamped and mesh.contact are swapped.
#pragma once
#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// At the start, and where the rim follows its tables at all times of the run. @throws InputError
void refuse_held_in_ground(const Case& c, const Setup& s);
/// A question to the user if the held nodes of a wheel on a rim that forces move are farther from
/// the center than its contact nodes; empty if they are not.
[[nodiscard]] std::string held_outside_contact(const Case& c, const Setup& s);
/// At the largest depth. @throws InputError
void refuse_held_in_ground(const Case& c, const CrushSetup& s);
/// For a wheel in three dimensions, at the largest depth of its crush. @param touch_height of the
/// center above the ground at first touch [m] @throws InputError
void refuse_held_in_ground(const Case& c, const mesh::Mesh& mesh, const CrushPath& path,
                           double touch_height);
/// For steady rolling at a given height. @throws InputError
void refuse_held_in_ground(const Case& c, const mesh::Mesh& mesh);

/// Largest distance of held nodes from the center towards the ground below a wheel that leans, in
/// any of its positions [m].
[[nodiscard]] double held_reach(const mesh::Mesh& mesh, double camber);

/// Radius of held nodes that are about as far from the origin as each other; 0: they are not, or
/// nothing is held [m]
[[nodiscard]] double held_radius(const mesh::Mesh& mesh);

}  // namespace rondo::study
