// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/assembly.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::fem {
namespace {

struct CellCorners {
  std::array<Vec2, 4> x;
  std::size_t n;
  [[nodiscard]] std::span<const Vec2> span() const { return {x.data(), n}; }
};

CellCorners cell_corners(const mesh::Mesh& mesh, const mesh::Cell& cell) {
  CellCorners c{{}, static_cast<std::size_t>(mesh::n_corners(cell))};
  for (std::size_t a = 0; a < c.n; ++a)
    c.x[a] = mesh.coordinates[static_cast<std::size_t>(cell[a])];
  return c;
}

/// @pre the cell is not inverted
ElementMatrix elastic_stiffness(const mesh::Mesh& mesh, std::size_t cell, const ElementLaw& law) {
  const mesh::Cell& nodes = mesh.cells[cell];
  const CellCorners corners = cell_corners(mesh, nodes);
  RONDO_DEMAND(smallest_jacobian(corners.span()) > 0.0, nodes[0], nodes[1], nodes[2], nodes[3]);
  return element_stiffness(corners.span(), law);
}

ElementMatrix geometric_stiffness(const mesh::Mesh& mesh, std::span<const Vec2> prestress,
                                  std::size_t cell, const ElementLaw& law,
                                  const NodalDilatation& dilatation) {
  const CellCorners corners = cell_corners(mesh, mesh.cells[cell]);
  const auto displacement = [&](int node) { return prestress[static_cast<std::size_t>(node)]; };
  std::array<Vec2, 4> u;
  for (std::size_t a = 0; a < corners.n; ++a) u[a] = displacement(mesh.cells[cell][a]);
  const double mean =
      dilatation.holds(cell) ? dilatation.mean_stress_of_cell(cell, displacement) : 0.0;
  return element_geometric_stiffness(corners.span(), {u.data(), corners.n}, law, mean);
}

/// Largest eigenvalue of the element's own M_e⁻¹ K_e [1/s²].
double largest_eigenvalue(const mesh::Mesh& mesh, std::span<const Material> materials,
                          std::span<const Vec2> prestress, std::size_t e,
                          const NodalDilatation& dilatation) {
  const CellCorners corners = cell_corners(mesh, mesh.cells[e]);
  ElementLaw law = element_law(material_of(mesh, materials, e));
  ElementMatrix k = elastic_stiffness(mesh, e, law);
  if (dilatation.holds(e)) law.mean_bulk = 0.0;  // the patches give its volumetric stress
  if (!prestress.empty()) k += geometric_stiffness(mesh, prestress, e, law, dilatation);
  const std::array<double, 4> m =
      element_masses(corners.span(), material_of(mesh, materials, e).density);
  for (Eigen::Index i = 0; i < k.rows(); ++i)
    for (Eigen::Index j = 0; j < k.cols(); ++j)
      k(i, j) /= std::sqrt(m[static_cast<std::size_t>(i / 2)] * m[static_cast<std::size_t>(j / 2)]);
  const Eigen::SelfAdjointEigenSolver<ElementMatrix> solver(k, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;  // if there is no element
  for (const double value : values) largest = std::max(largest, value);
  return largest;
}

/// (n) Sum of the element masses for the given density of each cell.
template <class Density>
std::vector<double> sum_at_nodes(const mesh::Mesh& mesh, Density&& density) {
  std::vector<double> sum(mesh.n_nodes(), 0.0);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const CellCorners corners = cell_corners(mesh, mesh.cells[e]);
    const std::array<double, 4> m = element_masses(corners.span(), density(e));
    for (std::size_t a = 0; a < corners.n; ++a)
      sum[static_cast<std::size_t>(mesh.cells[e][a])] += m[a];
  }
  return sum;
}

}  // namespace

BlockCsr stiffness_pattern(const mesh::Mesh& mesh, const NodalDilatation& dilatation) {
  const std::vector<char> clamped = clamped_flags(mesh);
  const auto free = [&](int node) { return !clamped[static_cast<std::size_t>(node)]; };
  std::vector<std::vector<std::int32_t>> rows(mesh.n_nodes());
  const auto couple = [&](int row, int column) {
    if (free(row) && free(column)) rows[static_cast<std::size_t>(row)].push_back(column);
  };
  for (const mesh::Cell& cell : mesh.cells)
    for (int a = 0; a < mesh::n_corners(cell); ++a)
      for (int b = 0; b < mesh::n_corners(cell); ++b)
        couple(cell[static_cast<std::size_t>(a)], cell[static_cast<std::size_t>(b)]);
  for (std::size_t p = 0; p < dilatation.size(); ++p)
    for (const auto& a : dilatation.terms(p))
      for (const auto& b : dilatation.terms(p)) couple(a.node, b.node);
  BlockCsr k;
  k.row_start.push_back(0);
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    k.column.insert(k.column.end(), row.begin(), row.end());
    k.row_start.push_back(static_cast<std::int64_t>(k.column.size()));
    row = {};
  }
  k.values.assign(k.column.size(), BlockCsr::Block{});
  return k;
}

BlockCsr::Block* find_block(BlockCsr& k, int row, int column) {
  const auto begin = k.column.begin() + k.row_start[static_cast<std::size_t>(row)];
  const auto end = k.column.begin() + k.row_start[static_cast<std::size_t>(row) + 1];
  const auto it = std::lower_bound(begin, end, column);
  return it != end && *it == column ? &k.values[static_cast<std::size_t>(it - k.column.begin())]
                                    : nullptr;
}

void add_cell(BlockCsr& k, const mesh::Cell& cell, const ElementMatrix& e) {
  const int n = mesh::n_corners(cell);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      BlockCsr::Block* block =
          find_block(k, cell[static_cast<std::size_t>(a)], cell[static_cast<std::size_t>(b)]);
      if (!block) continue;
      // Both triangles use the same entry of e, so that K is bitwise symmetric.
      const auto entry = [&](int i, int j) { return e(std::min(i, j), std::max(i, j)); };
      (*block)[0] += entry(2 * a, 2 * b);
      (*block)[1] += entry(2 * a + 1, 2 * b);
      (*block)[2] += entry(2 * a, 2 * b + 1);
      (*block)[3] += entry(2 * a + 1, 2 * b + 1);
    }
}

/// (x y) equals (y x) bit for bit, so K remains bitwise symmetric.
void add_product(BlockCsr& k, double factor, std::span<const NodalDilatation::Term> terms) {
  for (const auto& [row, a] : terms)
    for (const auto& [column, b] : terms) {
      BlockCsr::Block* block = find_block(k, row, column);
      if (!block) continue;
      (*block)[0] += factor * (a.x * b.x);
      (*block)[1] += factor * (a.y * b.x);
      (*block)[2] += factor * (a.x * b.y);
      (*block)[3] += factor * (a.y * b.y);
    }
}

ElementMatrix cell_stiffness(const mesh::Mesh& mesh, std::span<const Material> materials,
                             std::span<const Vec2> prestress, std::size_t cell,
                             const NodalDilatation& dilatation) {
  ElementLaw law = element_law(material_of(mesh, materials, cell));
  if (dilatation.holds(cell)) law.mean_bulk = 0.0;
  ElementMatrix k = elastic_stiffness(mesh, cell, law);
  if (!prestress.empty()) k += geometric_stiffness(mesh, prestress, cell, law, dilatation);
  return k;
}

BlockCsr assemble_stiffness(const mesh::Mesh& mesh, std::span<const Material> materials,
                            std::span<const Vec2> prestress) {
  const NodalDilatation dilatation(mesh, materials);
  BlockCsr k = stiffness_pattern(mesh, dilatation);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    add_cell(k, mesh.cells[e], cell_stiffness(mesh, materials, prestress, e, dilatation));
  for (std::size_t p = 0; p < dilatation.size(); ++p)
    add_product(k, dilatation.stiffness(p), dilatation.terms(p));  // κ V b bᵀ, b the gradient
  return k;
}

std::vector<double> lumped_mass(const mesh::Mesh& mesh, std::span<const Material> materials) {
  return sum_at_nodes(mesh, [&](std::size_t e) { return material_of(mesh, materials, e).density; });
}

std::vector<double> nodal_areas(const mesh::Mesh& mesh) {
  return sum_at_nodes(mesh, [](std::size_t) { return 1.0; });
}

std::vector<double> element_eigenvalues(const mesh::Mesh& mesh, std::span<const Material> materials,
                                        std::span<const Vec2> prestress, bool one_sector) {
  const NodalDilatation dilatation(mesh, materials);
  const auto in_sector_0 = [&](int node) {
    return node >= 0 && mesh.sector[static_cast<std::size_t>(node)] == 0;
  };
  std::vector<double> values(mesh.cells.size(), 0.0);
  for (std::size_t e = 0; e < values.size(); ++e)
    if (!one_sector || std::ranges::any_of(mesh.cells[e], in_sector_0))
      values[e] = largest_eigenvalue(mesh, materials, prestress, e, dilatation);
  return values;
}

double element_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials,
                                std::span<const Vec2> prestress) {
  return largest_of(element_eigenvalues(mesh, materials, prestress, false));
}

double sector_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials,
                               std::span<const Vec2> prestress) {
  RONDO_DEMAND(mesh.n_sectors > 0, mesh.n_sectors);
  return largest_of(element_eigenvalues(mesh, materials, prestress, true));
}

std::vector<int> free_nodes(const mesh::Mesh& mesh) {
  const std::vector<char> clamped = clamped_flags(mesh);
  std::vector<int> free;
  for (std::size_t i = 0; i < mesh.n_nodes(); ++i)
    if (!clamped[i]) free.push_back(static_cast<int>(i));
  return free;
}

Eigen::SparseMatrix<double> free_matrix(const BlockCsr& k, std::span<const int> free) {
  std::vector<int> place(k.n_rows(), -1);
  for (std::size_t i = 0; i < free.size(); ++i)
    place[static_cast<std::size_t>(free[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * k.values.size());
  for (std::size_t row = 0; row < k.n_rows(); ++row)
    for (auto at = k.row_start[row]; at < k.row_start[row + 1]; ++at) {
      const auto b = static_cast<std::size_t>(at);
      const int i = place[row], j = place[static_cast<std::size_t>(k.column[b])];
      if (i < 0 || j < 0) continue;
      for (int c = 0; c < 4; ++c)
        entries.emplace_back(2 * i + c % 2, 2 * j + c / 2,
                             k.values[b][static_cast<std::size_t>(c)]);
    }
  const auto n = static_cast<Eigen::Index>(2 * free.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace rondo::fem
