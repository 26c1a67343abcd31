// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case to the model of a wheel in three dimensions (docs/wheel3d.md).
#pragma once
#include "rondo/analysis/build/build.hpp"

namespace rondo::study {

/// Model, critical step and figures of s.mesh, which is solid, as its materials are.
/// @throws InputError: as add_pressures()
void make_solid_body(const Case& c, int threads, Setup& s);

/// (n) positions at the start along t1, n and t2 [m].
std::vector<Vec3> solid_positions(const Setup& s);

/// The pressures of the case on its surfaces. @throws InputError: no such curve in the section, or
/// one that is held
void add_solid_pressures(const Case& c, const mesh::Mesh& mesh, dynamics::SolidBody& body);

/// (n_local of the sector) the forces of these at a time, in the frame of a sector; empty: none
/// [N].
[[nodiscard]] std::vector<Vec3> solid_sector_load(const Case& c, const mesh::Mesh& mesh,
                                                  const fem::SolidSector& sector, double time);

/// Extent along the axle [m].
double width_of(const mesh::Mesh& mesh);

/// Adds the figures of the wheel that `rondo check` prints.
void tell_solid_figures(const Case& c, Setup& s);

}  // namespace rondo::study
