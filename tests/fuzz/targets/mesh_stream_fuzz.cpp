// SPDX-License-Identifier: BSD-3-Clause
/// What the program rondo-mesh-reader writes of a Gmsh file, which may have taken it over: the
/// mesh that comes of it is sound. Input: a byte that chooses what is asked of the file, then the
/// stream (gmsh_stream.hpp). The program itself: tests/fuzz/mesh_reader_fuzz.cpp.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/mesh/gmsh_draft.hpp"
#include "rondo/mesh/mesh_check.hpp"

using namespace rondo;
using namespace rondo::mesh;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  if (seed % 4 == 0) return LLVMFuzzerMutate(data, size, max);
  return fuzz::mutate_in_place(data, size, seed / 4, 0);
}

namespace {

/// Names of groups in tests/meshes/mixed.geo.
MeshRequest request_of(unsigned choice) {
  MeshRequest request{.file = "fuzz.msh"};
  if ((choice & 2U) != 0) request.clamped = {"foot"};
  if ((choice & 4U) != 0) request.contact = "top";
  if ((choice & 8U) != 0) request.surfaces = {"left"};
  if ((choice & 16U) != 0) request.curves = {"top"};
  if ((choice & 32U) != 0) request.scale = 1e-3;
  return request;
}

void check_mesh(const Mesh& m) {
  const int n = static_cast<int>(m.n_nodes());
  const auto known = [&](int node) { return node >= 0 && node < n; };
  fuzz::check(!m.cells.empty(), "no cells");
  fuzz::check(std::ranges::all_of(m.coordinates, fuzz::is_finite), "a node is nowhere");
  for (const Cell& cell : m.cells)
    for (int a = 0; a < n_corners(cell); ++a)
      fuzz::check(known(cell[static_cast<std::size_t>(a)]), "a cell without its node");
  fuzz::check(check_cells(m).count() == 0, "a bad cell");
  fuzz::check(m.boundary.size() == m.tributary.size(), "contact nodes without length");
  fuzz::check(std::ranges::all_of(m.boundary, known), "a contact node is no node");
  fuzz::check(std::ranges::all_of(m.clamped, known), "a clamped node is none");
  fuzz::check(m.region.empty() || m.region.size() == m.cells.size(), "cells without region");
  for (const int region : m.region)
    fuzz::check(region >= 0 && region < static_cast<int>(m.region_names.size()), "no such region");
  for (const Curve& curve : m.curves)
    for (const Edge& edge : curve.edges)
      fuzz::check(known(edge[0]) && known(edge[1]), "an edge without its node");
  for (const double length : m.tributary)
    fuzz::check(std::isfinite(length) && length > 0.0, "a contact node without length");
  // Each node has a share of a cell, so that it has a mass.
  for (const double area : fem::nodal_areas(m))
    fuzz::check(std::isfinite(area) && area > 0.0, "a node without area");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const unsigned choice = data[0];
  std::size_t at = 1;
  const ReadBytes read = [&](void* to, std::size_t room) {
    const std::size_t n = std::min(room, size - at);
    if (n > 0) std::memcpy(to, data + at, n);
    at += n;
    return n;
  };
  RawStream stream;
  try {
    stream = read_stream(read, 4 * size);  // as large as a file of these numbers may be
  } catch (const BadStream&) {
    return 0;
  }
  if (!stream.mesh) return 0;
  ReadMesh found;
  if (fuzz::accepted([&] { found = mesh_of(*stream.mesh, choice % 2 == 1, request_of(choice)); }))
    check_mesh(found.mesh);
  return 0;
}
