// SPDX-License-Identifier: BSD-3-Clause
/// @file  Mass and size of each region of the mesh: a body that is half of what it should be shows.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

struct RegionFigures {
  std::string name;  ///< physical surface; empty: of none, or the mesh has no regions
  std::size_t elements = 0;
  double size = 0.0;  ///< area [m²]; in three dimensions volume [m³]
  double mass = 0.0;  ///< [kg/m]; in three dimensions [kg]
};

/// One for each region, at least one. @param materials one for each region
[[nodiscard]] std::vector<RegionFigures> region_figures(const mesh::Mesh& mesh,
                                                        std::span<const fem::Material> materials);

/// For `rondo check`: the whole, and where there are several regions each of them.
[[nodiscard]] std::vector<Told> region_lines(const mesh::Mesh& mesh,
                                             std::span<const fem::Material> materials);

/// Adds "mass", "area" or "volume", and "regions" to run.json.
void describe_regions(const mesh::Mesh& mesh, std::span<const fem::Material> materials, Json& json);
std::vector<MemberText> region_members();

}  // namespace rondo::study
