// SPDX-License-Identifier: BSD-3-Clause
/// @file  The generated wheel in three dimensions that a case describes.
#pragma once
#include "rondo/case/case.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace rondo::study {

/// @pre the case has a disk with a width
inline mesh::Wheel wheel_of(const Case& c) {
  return {c.disk, *c.wheel.width, c.wheel.axial, c.wheel.crown_radius, c.wheel.grooves};
}

/// Nodes of a generated mesh, plane or solid; for a solid with a tread an upper bound.
inline std::size_t n_generated_nodes(const Case& c) noexcept {
  return c.wheel.width ? mesh::n_wheel_nodes(wheel_of(c)) : mesh::n_disk_nodes(c.disk);
}

}  // namespace rondo::study
