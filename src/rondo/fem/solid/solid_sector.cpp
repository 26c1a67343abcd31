// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/solid/solid_sector.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/sector_rows.hpp"
#include "rondo/fem/solid/corners.hpp"

namespace rondo::fem {
namespace {

std::vector<detail::SectorElement> elements_of_sector(const mesh::Mesh& mesh) {
  return detail::sector_elements(
      mesh, mesh.hexahedra.size(),
      [&](std::size_t e) -> std::span<const int> { return mesh.hexahedra[e]; });
}

}  // namespace

SolidSector assemble_solid_sector(const mesh::Mesh& mesh, std::span<const Material> materials) {
  RONDO_DEMAND(mesh.is_solid());
  const std::vector<detail::SectorElement> elements = elements_of_sector(mesh);
  const detail::SectorRows rows = detail::sector_rows(mesh, elements);
  const auto stiffness = [&](std::size_t e) {
    const HexahedronCorners x = corners_of(mesh, e);
    RONDO_DEMAND(smallest_jacobian(x) > 0.0, e);
    return hexahedron_stiffness(x, material_of(mesh, materials, e));
  };
  return detail::sector_blocks<3>(detail::forward_blocks<3>(elements, rows, stiffness), rows);
}

std::vector<double> solid_mass(const mesh::Mesh& mesh, std::span<const Material> materials) {
  RONDO_DEMAND(mesh.n_sectors > 0, mesh.n_sectors);
  const std::size_t n = mesh.n_nodes() / static_cast<std::size_t>(mesh.n_sectors);
  std::vector<double> mass(n, 0.0);  // of sector 0
  for (const detail::SectorElement& c : elements_of_sector(mesh)) {
    const double density = material_of(mesh, materials, c.element).density;
    const std::array<double, 8> volume = hexahedron_volumes(corners_of(mesh, c.element));
    for (std::size_t i = 0; i < 8; ++i)
      if (c.shift[i] == 0) mass[at(c.node[i])] += density * volume[i];
  }
  mass.resize(mesh.n_nodes());
  for (std::size_t i = n; i < mass.size(); ++i) mass[i] = mass[i - n];
  return mass;
}

double solid_eigenvalue_bound(const mesh::Mesh& mesh, std::span<const Material> materials) {
  double largest = 0.0;
  for (const detail::SectorElement& c : elements_of_sector(mesh))
    largest =
        std::max(largest, hexahedron_eigenvalue_bound(corners_of(mesh, c.element),
                                                      material_of(mesh, materials, c.element)));
  return largest;
}

std::vector<Vec3> sector_pressure(const mesh::Mesh& mesh, const SolidSector& k,
                                  std::span<const mesh::Face> faces) {
  std::vector<std::size_t> row_of(static_cast<std::size_t>(k.nodes_per_sector), k.n_local());
  for (std::size_t a = 0; a < k.n_local(); ++a) row_of[at(k.nodes[a])] = a;
  std::vector<Vec3> force(k.n_local());
  for (const mesh::Face& face : faces) {
    const bool touches =
        std::ranges::any_of(face, [&](int node) { return mesh.sector[at(node)] == 0; });
    if (!touches) continue;
    const std::array<Vec3, 4> share = mesh::face_shares(mesh::face_corners(mesh, face));
    for (std::size_t i = 0; i < 4; ++i) {
      const auto node = static_cast<std::size_t>(face[i]);
      const std::size_t row = row_of[at(mesh.sector_node[node])];
      if (mesh.sector[node] == 0 && row < k.n_local()) force[row] -= share[i];
    }
  }
  return force;
}

void apply(const SolidSector& k, std::span<const Vec3> u, std::span<Vec3> out) {
  const auto n = static_cast<std::size_t>(k.n_sectors);
  std::fill(out.begin(), out.end(), Vec3{});
  for (std::size_t j = 0; j < n; ++j) {
    const std::array<std::size_t, 3> sector{(j + n - 1) % n, j, (j + 1) % n};
    for (std::size_t a = 0; a < k.n_local(); ++a) {
      Vec3 sum;
      for (const SolidSector::Entry& e : k.row(a)) {
        const int place = e.shift + 1;
        const std::size_t there = sector[at(place)];
        const std::size_t node = k.node(static_cast<std::size_t>(e.column), there);
        const auto [x, y, z] = conj(k.turn[there]) * u[node];
        const auto& b = e.block;
        sum += {b[0] * x + b[3] * y + b[6] * z, b[1] * x + b[4] * y + b[7] * z,
                b[2] * x + b[5] * y + b[8] * z};
      }
      out[k.node(a, j)] = k.turn[j] * sum;
    }
  }
}

SectorStiffness plane_part(const SolidSector& k) {
  SectorStiffness plane{k.n_sectors, k.nodes_per_sector, k.nodes, k.row_start, {}, k.turn};
  plane.entries.reserve(k.entries.size());
  for (const auto& [column, shift, b] : k.entries)
    plane.entries.push_back({column, shift, {b[0], b[1], b[3], b[4]}});
  return plane;
}

}  // namespace rondo::fem
