// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/contact_mass.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "rondo/core/index.hpp"

namespace rondo::fem {
namespace {

/// Whether two corners of a hexahedron have an edge in common: those of a face and of the opposite
/// one come one after the other.
bool joined(int a, int b) noexcept {
  if (a / 4 != b / 4) return a % 4 == b % 4;
  return (a % 4 + 1) % 4 == b % 4 || (b % 4 + 1) % 4 == a % 4;
}

/// Neighbours of each contact node.
struct Beside {
  std::vector<std::vector<int>> by_edge, by_cell;  ///< (contact) ascending, each once
};

Beside find_beside(const mesh::Mesh& mesh, std::span<const int> place, std::size_t n_contact) {
  Beside beside{std::vector<std::vector<int>>(n_contact), std::vector<std::vector<int>>(n_contact)};
  for (const mesh::Cell& cell : mesh.cells) {
    const int n = mesh::n_corners(cell);
    for (int a = 0; a < n; ++a) {
      if (place[at(cell[at(a)])] < 0) continue;
      const std::size_t i = at(place[at(cell[at(a)])]);
      for (int b = 0; b < n; ++b) {
        if (b == a) continue;
        beside.by_cell[i].push_back(cell[at(b)]);
        if ((a + 1) % n == b || (b + 1) % n == a) beside.by_edge[i].push_back(cell[at(b)]);
      }
    }
  }
  for (const mesh::Hexahedron& cell : mesh.hexahedra)
    for (int a = 0; a < 8; ++a) {
      if (place[at(cell[at(a)])] < 0) continue;
      const std::size_t i = at(place[at(cell[at(a)])]);
      for (int b = 0; b < 8; ++b) {
        if (b == a) continue;
        beside.by_cell[i].push_back(cell[at(b)]);
        if (joined(a, b)) beside.by_edge[i].push_back(cell[at(b)]);
      }
    }
  for (auto* lists : {&beside.by_edge, &beside.by_cell})
    for (std::vector<int>& list : *lists) {
      std::ranges::sort(list);
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  return beside;
}

/// Terms of a mass field: sum, first and polar moment, about a center, scaled by a length.
Eigen::Vector4d terms(Vec2 x) {
  return {1.0, x.x, x.y, dot(x, x)};
}

}  // namespace

MovedMass move_contact_mass(const mesh::Mesh& mesh, std::span<const double> mass,
                            std::span<const int> contact) {
  MovedMass out{{mass.begin(), mass.end()}};
  std::vector<int> place(mesh.n_nodes(), -1);
  for (std::size_t i = 0; i < contact.size(); ++i) place[at(contact[i])] = static_cast<int>(i);
  const std::vector<char> clamped = mesh::clamped_flags(mesh);
  Beside beside = find_beside(mesh, place, contact.size());
  const auto cannot_take = [&](int node) { return place[at(node)] >= 0 || clamped[at(node)] != 0; };
  for (std::size_t i = 0; i < contact.size(); ++i) {
    for (auto* lists : {&beside.by_edge, &beside.by_cell}) std::erase_if((*lists)[i], cannot_take);
    const std::vector<int>& taking =
        beside.by_edge[i].empty() ? beside.by_cell[i] : beside.by_edge[i];
    if (taking.empty() && out.without_neighbour < 0) out.without_neighbour = contact[i];
    const double moved = std::exchange(out.mass[at(contact[i])], 0.0);
    for (const int node : taking) out.mass[at(node)] += moved / static_cast<double>(taking.size());
  }
  return out;
}

bool keep_moments(const mesh::Mesh& mesh, std::span<const double> like, std::span<const int> nodes,
                  std::vector<double>& mass) {
  double size = 0.0;
  for (const int node : nodes) size = std::max(size, norm(mesh.coordinates[at(node)]));
  const auto scaled = [&](int node) { return mesh.coordinates[at(node)] / size; };
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  Eigen::Vector4d lack = Eigen::Vector4d::Zero();
  for (const int node : nodes) {
    const Eigen::Vector4d t = terms(scaled(node));
    moments += mass[at(node)] * t * t.transpose();
    lack += (like[at(node)] - mass[at(node)]) * t;
  }
  const Eigen::Vector4d factors = moments.completeOrthogonalDecomposition().solve(lack);
  constexpr double round_off = 1e-10;
  if (!((moments * factors - lack).norm() <= round_off * moments(0, 0))) return false;
  std::vector<double> kept(mass);
  for (const int node : nodes) {
    kept[at(node)] *= 1.0 + factors.dot(terms(scaled(node)));
    if (mass[at(node)] > 0.0 && !(kept[at(node)] > 0.0)) return false;
  }
  mass = std::move(kept);
  return true;
}

}  // namespace rondo::fem
