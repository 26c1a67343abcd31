// SPDX-License-Identifier: BSD-3-Clause
/// @file  Global matrices: lumped mass and the stiffness in 2×2 blocks (docs/theory.md, 2.4, 2.5).
/// In all functions, `materials` has one entry for each region of the mesh (material_of), and
/// `prestress` is an (n) displacement whose stress stiffens the body, (2.8) [m]; empty: none.
#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rondo/fem/element.hpp"
#include "rondo/fem/nodal_dilatation.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::fem {

/// Stiffness of one cell: elastic, and geometric if there is prestress [N/m²]. A triangle held by
/// `dilatation` gives its deviatoric part alone; assemble_stiffness adds that of the patches.
/// @pre the cell is not inverted.
ElementMatrix cell_stiffness(const mesh::Mesh& mesh, std::span<const Material> materials,
                             std::span<const Vec2> prestress, std::size_t cell,
                             const NodalDilatation& dilatation);

/// Compressed sparse rows of 2×2 blocks, one row per node. Rows and columns of clamped nodes are
/// empty: the stored blocks act on free nodes.
struct BlockCsr {
  /// Stored column-major, [k_xx, k_yx, k_xy, k_yy]: a product adds column 0 times u_x and column 1
  /// times u_y, which suits two-wide SIMD.
  using Block = std::array<double, 4>;

  std::vector<std::int64_t> row_start;  ///< (n + 1) first block of a row
  std::vector<std::int32_t> column;     ///< (blocks) node, ascending in a row
  std::vector<Block> values;            ///< (blocks)                                     [N/m²]

  [[nodiscard]] std::size_t n_rows() const noexcept { return row_start.size() - 1; }
};

/// The columns of each row: free nodes that share a cell or a mean dilatation with it; values 0.
BlockCsr stiffness_pattern(const mesh::Mesh& mesh, const NodalDilatation& dilatation);

/// Null if the row or the column belongs to a clamped node, or the pattern has no such block.
BlockCsr::Block* find_block(BlockCsr& k, int row, int column);

/// Adds a cell's matrix; only its upper triangle is read, for both triangles.
void add_cell(BlockCsr& k, const mesh::Cell& cell, const ElementMatrix& e);

/// Adds factor · b bᵀ, where b holds the gradients of the terms.
void add_product(BlockCsr& k, double factor, std::span<const NodalDilatation::Term> terms);

/// Stiffness of the free nodes, including geometric stiffness. Bitwise symmetric. @pre no inverted
/// element.
BlockCsr assemble_stiffness(const mesh::Mesh& mesh, std::span<const Material> materials,
                            std::span<const Vec2> prestress = {});

/// (n) Lumped mass of all nodes, also clamped ones: the sum is ρ × area of the polygons [kg/m].
std::vector<double> lumped_mass(const mesh::Mesh& mesh, std::span<const Material> materials);

/// (n) Area that belongs to each node: the lumped mass for a density of 1 [m²].
std::vector<double> nodal_areas(const mesh::Mesh& mesh);

/// (e) Largest eigenvalue of each element's own M_e⁻¹ K_e [1/s²]. Triangles count as if they had
/// their own dilatation: a mean at the nodes has no more energy (2.3b). With `one_sector`, on a
/// cyclic mesh, only elements with a node in sector 0 are evaluated; the others are 0.
std::vector<double> element_eigenvalues(const mesh::Mesh& mesh, std::span<const Material> materials,
                                        std::span<const Vec2> prestress, bool one_sector);

/// Upper bound of the largest eigenvalue of M⁻¹K: the largest of element_eigenvalues() [1/s²]
/// (Irons and Treharne 1972), (3.8a).
double element_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials,
                                std::span<const Vec2> prestress = {});

/// The bound from the elements of one sector, equal to round-off. @pre a cyclic mesh.
double sector_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials,
                               std::span<const Vec2> prestress = {});

/// K of the nodes in `free` as a symmetric scalar matrix; an unknown has the number 2·(index in
/// `free`) + component. All other nodes are fixed.
Eigen::SparseMatrix<double> free_matrix(const BlockCsr& k, std::span<const int> free);

/// Nodes that are not clamped, ascending.
std::vector<int> free_nodes(const mesh::Mesh& mesh);

}  // namespace rondo::fem
