// SPDX-License-Identifier: BSD-3-Clause
/// @file  Stiffness of a mesh of N equal sectors: the row block of one sector is sufficient
/// (docs/theory.md, 2.7). In polar components, where each vector is turned into the frame of its
/// node's sector, K is block-circulant.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/elasticity.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// Rows are the free nodes of sector 0, layer after layer from the clamped nodes outwards, so that
/// a row couples only with rows nearby. Bitwise symmetric. A node has C components: two in the
/// frame of its sector, which for sector 0 is that of X, and in three dimensions the axial one.
template <int C>
struct SectorBlocks {
  static constexpr int components = C;
  /// C×C block that acts on local node `column` of the sector at distance `shift` (-1, 0, 1), in
  /// polar components, column-major as in BlockCsr [N/m²], in three dimensions [N/m].
  struct Entry {
    int column;
    int shift;
    std::array<double, static_cast<std::size_t>(C* C)> block;
  };

  int n_sectors = 0;
  int nodes_per_sector = 0;            ///< in the mesh, including clamped nodes
  std::vector<int> nodes;              ///< (n_local) number of each row's node within the sector
  std::vector<std::size_t> row_start;  ///< (n_local + 1) first entry of a row
  std::vector<Entry> entries;
  std::vector<Complex> turn;  ///< (N) e^{iφ_j}, φ_j = 2πj/N: frame of sector j

  [[nodiscard]] std::size_t n_local() const noexcept { return nodes.size(); }
  /// The node of the mesh that belongs to row `a` of sector `j`.
  [[nodiscard]] std::size_t node(std::size_t a, std::size_t j) const noexcept {
    return j * static_cast<std::size_t>(nodes_per_sector) + static_cast<std::size_t>(nodes[a]);
  }
  [[nodiscard]] std::span<const Entry> row(std::size_t a) const noexcept {
    return std::span(entries).subspan(row_start[a], row_start[a + 1] - row_start[a]);
  }
};

using SectorStiffness = SectorBlocks<2>;
using SolidSector = SectorBlocks<3>;

/// @param materials one for each region of the mesh (material_of).
/// @param prestress (n) displacement, the same in each sector, whose stress stiffens the body,
///        (2.8) [m]; empty: none.
/// @pre the mesh has N >= 3 equal sectors, numbered one after the other
/// @pre no inverted element
/// @pre no triangles with a mean dilatation at the nodes.
SectorStiffness assemble_sector(const mesh::Mesh& mesh, std::span<const Material> materials,
                                std::span<const Vec2> prestress = {});

/// out = K u, Cartesian components in the rotating frame, both (n); clamped nodes give 0. This is
/// the simple reference product; the time steps have their own.
void apply(const SectorStiffness& k, std::span<const Vec2> u, std::span<Vec2> out);

}  // namespace rondo::fem
