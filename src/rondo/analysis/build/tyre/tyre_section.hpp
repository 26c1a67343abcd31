// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case with [inflation] to the section of the wheel at finite strain.
#pragma once
#include "rondo/case/case.hpp"
#include "rondo/fem/finite/swept_section.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/statics/inflation/inflation.hpp"

namespace rondo::study {

/// @param section with the nodes of a sector, in their order
/// @param materials one for each region of the section, all of rubber
/// @throws InputError: a curve that is none, or cannot carry what the case puts there; a liner
/// whose end is not held; cords that do not fit
fem::finite::SweptSection tyre_section(const Case& c, const mesh::Mesh& section,
                                       const std::vector<fem::Material>& materials);

/// Pressure, spin and ways of the beads, for the nodes of the section. @throws InputError
statics::InflationLoads inflation_loads(const Case& c, const mesh::Mesh& section);

}  // namespace rondo::study
