// SPDX-License-Identifier: BSD-3-Clause
/// @file  The friction of a case of steady rolling: a constant, or a law over slip speed and
/// pressure.
#pragma once
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "rondo/contact/friction_table.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/statics/steady/law/rolling_friction.hpp"

namespace rondo::study {

/// The coefficient that the factors of the law are of; of a constant, the constant.
[[nodiscard]] inline double constant_part(const contact::FrictionTable& table) noexcept {
  return table.is_constant() ? contact::friction_at(table, {}).coefficient : table.coefficient;
}

/// The undeformed length, in space area, that the node of each row stands for, as in steps in time
/// [m], [m²]. @param rows of the sector, on the boundary
template <int D>
[[nodiscard]] std::vector<double> extents_of(const mesh::Mesh& mesh,
                                             const fem::SectorBlocks<D>& sector,
                                             std::span<const int> rows) {
  std::vector<double> of_node(mesh.n_nodes()), extents;
  for (std::size_t k = 0; k < mesh.boundary.size(); ++k)
    of_node[at(mesh.boundary[k])] = mesh.tributary[k];
  for (const int row : rows) extents.push_back(of_node[sector.node(at(row), 0)]);
  return extents;
}

/// @param extent (candidates) length, in space area, that a node stands for [m], [m²]. @return
/// none: friction is constant
[[nodiscard]] inline std::optional<statics::RollingFriction> rolling_friction_of(
    contact::FrictionTable table, std::vector<double> extent) {
  if (table.is_constant()) return std::nullopt;
  table.coefficient = 1.0;
  return statics::RollingFriction{std::move(table), std::move(extent)};
}

}  // namespace rondo::study
