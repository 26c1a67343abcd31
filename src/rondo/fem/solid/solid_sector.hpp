// SPDX-License-Identifier: BSD-3-Clause
/// @file  Stiffness, masses and loads of a wheel of equal sectors of hexahedra.
#pragma once
#include <span>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/fem/solid/solid_stress.hpp"

namespace rondo::fem {

/// @param materials one for each region of the mesh (material_of).
/// @pre the mesh is solid, with N >= 3 equal sectors; no inverted element.
SolidSector assemble_solid_sector(const mesh::Mesh& mesh, std::span<const Material> materials);

/// (n) lumped by the volumes of the corners (hexahedron_volumes), bitwise equal in all sectors
/// [kg].
std::vector<double> solid_mass(const mesh::Mesh& mesh, std::span<const Material> materials);

/// The maximum of hexahedron_eigenvalue_bound over the elements: an upper bound of ω² [1/s²].
double solid_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials);

/// (n_local of k) force per unit of pressure against the outward normals of the faces of one sector
/// [m²]; components in the sector's frame, which is that of X in sector 0, and along the axle. Only
/// faces of sector 0 and its neighbours are examined.
std::vector<Vec3> sector_pressure(const mesh::Mesh& mesh, const SolidSector& k,
                                  std::span<const mesh::Face> faces);

/// K u in the rotating frame, (n) each; clamped nodes give 0. Simple reference implementation.
void apply(const SolidSector& k, std::span<const Vec3> u, std::span<Vec3> out);

/// Stiffness of the radial and tangential components alone, as if no node moved along the axle.
/// Nodes of a section that differ only in their axial position remain separate [N/m].
SectorStiffness plane_part(const SolidSector& k);

}  // namespace rondo::fem
