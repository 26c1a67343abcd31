// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cyclic bodies that several tests use: disks, and rings of one node per sector with known
/// eigenvalues.
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/mesh/disk.hpp"

namespace rondo::test {

/// Smooth, graded and treaded disks; N odd and even, the smallest N; the largest eigenvalue in the
/// first and in the last harmonic, the lowest in harmonic 0 and (the last disk) in harmonic 1.
inline std::vector<mesh::Disk> cyclic_disks() {
  mesh::Disk smooth, fine, graded, treaded, three, squat;
  smooth.radial = 5, smooth.circumferential = 33;
  fine.radial = 2, fine.circumferential = 90;
  graded.radial = 7, graded.circumferential = 24, graded.grading = 1.8;
  treaded.radial = 4, treaded.tread = mesh::Tread{.pitches = 11, .layers = 3};
  three.radial = 3, three.tread = mesh::Tread{.pitches = 3, .land_columns = 5, .groove_columns = 4};
  squat.radial = 20, squat.circumferential = 3;
  return {smooth, fine, graded, treaded, three, squat};
}

/// The same mesh with `columns` sectors combined into one.
inline mesh::Mesh with_wider_sectors(mesh::Mesh mesh, int columns) {
  const int nodes = static_cast<int>(mesh.n_nodes()) / mesh.n_sectors;
  for (std::size_t i = 0; i < mesh.n_nodes(); ++i) {
    mesh.sector_node[i] += mesh.sector[i] % columns * nodes;
    mesh.sector[i] /= columns;
  }
  mesh.n_sectors /= columns;
  return mesh;
}

/// One node of 1 kg/m per sector, coupled with both neighbours such that harmonic k has the
/// eigenvalues 5 + 2 cos(κ ± 2πp/N), κ = 2πk/N, times 1e6 1/s². The largest of all, 7e6, is in
/// harmonic p; for even N the lowest, 3e6, is in harmonic N/2 - p.
inline fem::SectorStiffness ring(int n_sectors, int p) {
  const double angle = 2.0 * std::numbers::pi * p / n_sectors;
  const double c = 1e6 * std::cos(angle), s = 1e6 * std::sin(angle);
  fem::SectorStiffness k;
  k.n_sectors = n_sectors;
  k.nodes_per_sector = 1;
  k.nodes = {0};
  k.row_start = {0, 3};
  k.entries = {{0, -1, {c, s, -s, c}}, {0, 0, {5e6, 0.0, 0.0, 5e6}}, {0, 1, {c, -s, s, c}}};
  for (int j = 0; j < n_sectors; ++j)
    k.turn.push_back(rotation(2.0 * std::numbers::pi * j / n_sectors));
  return k;
}

/// The ring with `others` further nodes per sector, of eigenvalue 1e6 each. Zeros couple the last
/// of them with the first, so that a factor would be full.
inline fem::SectorStiffness wide_ring(int n_sectors, int p, int others) {
  fem::SectorStiffness k = ring(n_sectors, p);
  k.nodes_per_sector = 1 + others;
  k.entries.push_back({others, 0, {}});
  k.row_start = {0, k.entries.size()};
  for (int a = 1; a <= others; ++a) {
    k.nodes.push_back(a);
    if (a == others) k.entries.push_back({0, 0, {}});
    k.entries.push_back({a, 0, {1e6, 0.0, 0.0, 1e6}});
    k.row_start.push_back(k.entries.size());
  }
  return k;
}

}  // namespace rondo::test
