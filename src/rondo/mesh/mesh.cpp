// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/mesh.hpp"

#include <algorithm>
#include <numeric>

#include "rondo/core/index.hpp"

namespace rondo::mesh {

std::vector<char> clamped_flags(const Mesh& mesh) {
  std::vector<char> flags(mesh.n_nodes(), 0);
  for (const int node : mesh.clamped) flags[at(node)] = 1;
  return flags;
}

Bodies find_bodies(const Mesh& mesh) {
  std::vector<int> root(mesh.n_nodes());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int node) {
    while (root[at(node)] != node) {
      int& up = root[at(node)];
      node = up = root[at(up)];
    }
    return node;
  };
  std::vector<char> used(mesh.n_nodes(), 0);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < n_corners(cell); ++a) {
      const int first = find(cell[0]), other = find(cell[at(a)]);
      used[at(cell[static_cast<std::size_t>(a)])] = 1;
      root[at(std::max(first, other))] = std::min(first, other);
    }
  Bodies bodies;
  bodies.of_node.assign(mesh.n_nodes(), -1);
  for (std::size_t k = 0; k < mesh.n_nodes(); ++k) {
    if (!used[k]) continue;
    const auto first = static_cast<std::size_t>(find(static_cast<int>(k)));  // the smallest number
    bodies.of_node[k] = first == k ? bodies.count++ : bodies.of_node[first];
  }
  return bodies;
}

Mesh mesh_of_cells(const Mesh& mesh, std::span<const char> kept) {
  Mesh part = mesh;
  part.cells.clear();
  part.region.clear();
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    if (!kept[e]) continue;
    part.cells.push_back(mesh.cells[e]);
    if (!mesh.region.empty()) part.region.push_back(mesh.region[e]);
  }
  return part;
}

}  // namespace rondo::mesh
