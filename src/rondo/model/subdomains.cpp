// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/subdomains.hpp"

#include <algorithm>
#include <iterator>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

Subdomain make_subdomain(const mesh::Mesh& part, std::span<const fem::Material> materials,
                         std::span<const Vec2> prestress) {
  RONDO_DEMAND(!part.cells.empty());
  Subdomain s;
  s.mass = fem::lumped_mass(part, materials);
  s.stiffness = fem::assemble_stiffness(part, materials, prestress);
  for (const int node : fem::free_nodes(part))
    if (s.mass[at(node)] > 0.0) s.free.push_back(node);
  return s;
}

}  // namespace

Subdomains make_subdomains(const mesh::Mesh& mesh, std::span<const fem::Material> materials,
                           std::span<const Vec2> prestress, std::span<const char> is_fine,
                           int ratio) {
  RONDO_DEMAND(is_fine.size() == mesh.cells.size() && ratio >= 1, is_fine.size(), ratio);
  std::vector<char> is_coarse;
  for (const char fine : is_fine) is_coarse.push_back(fine ? 0 : 1);
  Subdomains s;
  s.fine = make_subdomain(mesh_of_cells(mesh, is_fine), materials, prestress);
  s.coarse = make_subdomain(mesh_of_cells(mesh, is_coarse), materials, prestress);
  std::set_intersection(s.fine.free.begin(), s.fine.free.end(), s.coarse.free.begin(),
                        s.coarse.free.end(), std::back_inserter(s.interface));
  s.ratio = ratio;
  return s;
}

std::vector<int> distance_to_interface(const Subdomains& parts) {
  const fem::BlockCsr& k = parts.fine.stiffness;
  std::vector<int> distance(k.n_rows(), -1);
  std::vector<int> reached = parts.interface;
  for (const int node : reached) distance[at(node)] = 0;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const int from = reached[next];
    for (auto b = k.row_start[at(from)]; b < k.row_start[at(from) + 1]; ++b) {
      const int to = k.column[at(b)];
      if (distance[at(to)] >= 0) continue;
      distance[at(to)] = distance[at(from)] + 1;
      reached.push_back(to);
    }
  }
  return distance;
}

}  // namespace rondo::dynamics
