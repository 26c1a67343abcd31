// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/tangent_sector.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/sector_rows.hpp"

namespace rondo::fem::finite {
namespace {

using Block = detail::NodeBlock<3>;

/// Component c of a node, outwards, around and along the axle, in sector 0 along x, y and z: the
/// first is -y, the second x. @return its place among the three, and its sign
struct Axis {
  std::size_t component;
  double sign;
};
constexpr std::array<Axis, 3> axis_of{Axis{1, -1.0}, Axis{0, 1.0}, Axis{2, 1.0}};

/// Adds the entries of a matrix of the section to the blocks of free rows. Of a block on the
/// diagonal only the upper half is read.
void add(const Eigen::SparseMatrix<double>& k, int shift, const detail::SectorRows& rows,
         detail::SectorMap<3>& blocks) {
  for (Eigen::Index j = 0; j < k.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(k, j); it; ++it) {
      const auto i = static_cast<std::size_t>(it.row()), c = static_cast<std::size_t>(j);
      const int row = rows.place[i / 3], column = rows.place[c / 3];
      if (row < 0 || column < 0) continue;
      const auto [p, of_p] = axis_of[i % 3];
      const auto [q, of_q] = axis_of[c % 3];
      Block& block = blocks[{row, column, shift}];
      const bool diagonal = shift == 0 && row == column;
      if (diagonal && i % 3 > c % 3) continue;
      block[3 * q + p] = of_p * of_q * it.value();
      if (diagonal) block[3 * p + q] = block[3 * q + p];
    }
}

}  // namespace

SolidSector tangent_sector(const mesh::Mesh& mesh, const SectorState& state) {
  RONDO_DEMAND(
      mesh.is_solid() &&
          static_cast<std::size_t>(state.here.rows()) * at(mesh.n_sectors) == 3 * mesh.n_nodes(),
      mesh.n_nodes(), state.here.rows(), mesh.n_sectors);
  const auto elements = detail::sector_elements(
      mesh, mesh.hexahedra.size(),
      [&](std::size_t e) -> std::span<const int> { return mesh.hexahedra[e]; });
  const detail::SectorRows rows = detail::sector_rows(mesh, elements);
  detail::SectorMap<3> blocks;
  add(state.here, 0, rows, blocks);
  add(state.next, 1, rows, blocks);
  return detail::sector_blocks<3>(blocks, rows);
}

}  // namespace rondo::fem::finite
