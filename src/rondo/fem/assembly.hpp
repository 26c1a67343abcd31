// SPDX-License-Identifier: BSD-3-Clause
/// @file  Global matrices: lumped mass and the stiffness in 2×2 blocks (docs/theory.md, 2.4, 2.5).
/// `materials` everywhere: one for each region of the mesh (material_of). `prestress`: (n)
/// displacement whose stress stiffens the body, (2.8) [m]; empty: none.
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

/// Of one cell: elastic, and geometric where there is prestress [N/m²]. A triangle with its volume
/// in `dilatation` has its deviator alone; what the patches have comes beside (assemble_stiffness).
/// @pre the cell is not inverted.
ElementMatrix cell_stiffness(const mesh::Mesh& mesh, std::span<const Material> materials,
                             std::span<const Vec2> prestress, std::size_t cell,
                             const NodalDilatation& dilatation);

/// Compressed sparse rows of 2×2 blocks, one row a node. Rows and columns of clamped nodes are
/// empty: what is stored acts on free nodes.
struct BlockCsr {
  /// Stored column-major, [k_xx, k_yx, k_xy, k_yy]: a product adds column 0 times u_x, column 1
  /// times u_y, which is what two-wide SIMD does.
  using Block = std::array<double, 4>;

  std::vector<std::int64_t> row_start;  ///< (n + 1) first block of a row
  std::vector<std::int32_t> column;     ///< (blocks) node, ascending in a row
  std::vector<Block> values;            ///< (blocks)                                     [N/m²]

  [[nodiscard]] std::size_t n_rows() const noexcept { return row_start.size() - 1; }
};

/// Columns of each row: the free nodes that share a cell or a mean dilatation with it; values 0.
BlockCsr stiffness_pattern(const mesh::Mesh& mesh, const NodalDilatation& dilatation);

/// Null: the row or the column is of a clamped node, or the pattern has no such block.
BlockCsr::Block* find_block(BlockCsr& k, int row, int column);

/// Adds a cell's matrix, of which the upper triangle is taken for both.
void add_cell(BlockCsr& k, const mesh::Cell& cell, const ElementMatrix& e);

/// Adds factor · b bᵀ, b the gradients of the terms.
void add_product(BlockCsr& k, double factor, std::span<const NodalDilatation::Term> terms);

/// Stiffness of the free nodes, geometric stiffness included. Symmetric to the last bit. @pre no
/// inverted element.
BlockCsr assemble_stiffness(const mesh::Mesh& mesh, std::span<const Material> materials,
                            std::span<const Vec2> prestress = {});

/// (n) Lumped mass of every node, clamped ones included: sums to ρ × area of the polygons [kg/m].
std::vector<double> lumped_mass(const mesh::Mesh& mesh, std::span<const Material> materials);

/// (n) The same with a density of 1: area that a node stands for [m²].
std::vector<double> nodal_areas(const mesh::Mesh& mesh);

/// (e) Largest eigenvalue of each element's own M_e⁻¹ K_e [1/s²]. Triangles count with a dilatation
/// of their own: a mean at the nodes has no more energy (2.3b). On a cyclic mesh only elements with
/// a node in sector 0 are looked at, and others are 0, where `one_sector`.
std::vector<double> element_eigenvalues(const mesh::Mesh& mesh, std::span<const Material> materials,
                                        std::span<const Vec2> prestress, bool one_sector);

/// Upper bound of the largest eigenvalue of M⁻¹K: the largest of element_eigenvalues() [1/s²]
/// (Irons and Treharne 1972), (3.8a).
double element_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials,
                                std::span<const Vec2> prestress = {});

/// The same by the elements of one sector, to round-off. @pre a cyclic mesh.
double sector_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials,
                               std::span<const Vec2> prestress = {});

/// K of the nodes in `free` as a symmetric scalar matrix, numbered 2·(place in `free`) + component;
/// all others stay where they are.
Eigen::SparseMatrix<double> free_matrix(const BlockCsr& k, std::span<const int> free);

/// Nodes that are not clamped, ascending.
std::vector<int> free_nodes(const mesh::Mesh& mesh);

}  // namespace rondo::fem
