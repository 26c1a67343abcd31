// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a wheel at finite strain to the linear one about its state: the tangent as the
/// stiffness of a sector, for all steps and solvers that know such a stiffness.
#pragma once
#include <span>
#include <vector>

#include "rondo/fem/finite/sector_energy.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::fem::finite {

/// Rows and frames are those of assemble_solid_sector(): sector 0 begins straight down, its
/// components are along x and y. Without the stiffness of the spin.
/// @param mesh the revolved section, node by node in the order of the section
[[nodiscard]] SolidSector tangent_sector(const mesh::Mesh& mesh, const SectorState& state);

}  // namespace rondo::fem::finite
