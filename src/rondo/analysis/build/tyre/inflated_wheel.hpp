// SPDX-License-Identifier: BSD-3-Clause
/// @file  A wheel with [inflation]: its section at finite strain, its equilibria, and what is told
/// of them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/build/tyre/tyre_section.hpp"
#include "rondo/case/inflation_figures.hpp"

namespace rondo::study {

/// One sector stands for all. Displacements of the section's nodes are in the frame of the sector:
/// outwards, around, along the axle.
class InflatedWheel {
 public:
  /// @throws InputError as tyre_section(); a node without mass
  InflatedWheel(const Case& c, mesh::Mesh section, const std::vector<fem::Material>& materials);

  [[nodiscard]] const mesh::Mesh& section() const noexcept { return section_; }
  [[nodiscard]] const fem::finite::SectorEnergy& energy() const noexcept { return energy_; }
  [[nodiscard]] const statics::InflationLoads& loads() const noexcept { return loads_; }

 private:
  mesh::Mesh section_;
  fem::finite::SectorEnergy energy_;
  statics::InflationLoads loads_;
};

[[nodiscard]] InflationFigures figures_of(const InflatedWheel& wheel,
                                          const statics::Inflation& now);

/// Why there is no equilibrium beyond the last one.
[[nodiscard]] std::string no_equilibrium(const InflatedWheel& wheel, const statics::Inflation& now);
/// The waves in which an equilibrium buckles; empty: it is stable. Of one on the way to the loads
/// only whether all sectors buckle alike: from there others would follow.
[[nodiscard]] std::string instability(const InflatedWheel& wheel, const statics::Inflation& now);

/// The equilibrium under all loads. @throws InputError: there is none, or it is not stable
[[nodiscard]] statics::Inflation equilibrium_of(const Case& c, const InflatedWheel& wheel);

/// (n of the wheel) Displacements of all sectors in the axes of X. @param u (n of the section)
[[nodiscard]] std::vector<Vec3> in_all_sectors(const mesh::Mesh& wheel, std::span<const Vec3> u);

}  // namespace rondo::study
