// SPDX-License-Identifier: BSD-3-Clause
/// @file  Plane meshes from Gmsh files: MSH 2.2 and 4.1, text and binary, triangles and
/// quadrilaterals of first order.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// All names are those of physical groups; a group without a name is called by its number ("7").
struct MeshRequest {
  std::filesystem::path file{};
  double scale = 1.0;                  ///< m per unit of length of the file, > 0
  std::vector<std::string> clamped{};  ///< curves of clamped nodes
  std::string contact{};               ///< curve of contact candidates; empty: none
  std::vector<std::string> curves{};  ///< further ones that must exist, each a part of the boundary
  std::vector<std::string> lines{};   ///< further ones that must exist, on edges of cells
  std::vector<std::string> surfaces{};  ///< further ones that must exist
};

struct ReadMesh {
  Mesh mesh;
  std::vector<std::string> warnings;  ///< for the user, one line each
};

/// Nodes are numbered by their tags in the file, cells by surface, type and tag. `boundary` holds
/// the open lines of the contact curve first, then the closed ones, each with the body on its left.
/// Clamped nodes are left out, and contact_edges join the nodes that remain. `tributary` includes
/// every edge of the curve. `curves` has all physical curves of the file. An edge with cells on
/// both sides keeps its sense in the file; only curves not named by `contact` or `curves` may have
/// such edges. A node or an edge may be in several curves, a cell in one surface only. Throws
/// InputError with all faults of a kind, FileError if the file cannot be opened or the program that
/// reads it cannot be run.
ReadMesh read_gmsh(const MeshRequest& request);

}  // namespace rondo::mesh
