// SPDX-License-Identifier: BSD-3-Clause
/// @file  Plane meshes from Gmsh files: MSH 2.2 and 4.1, text and binary, triangles and
/// quadrilaterals of first order.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// Names are those of physical groups; a group without a name goes by its number ("7").
struct MeshRequest {
  std::filesystem::path file{};
  double scale = 1.0;                 ///< m per unit of length of the file, > 0
  std::string clamped{};              ///< curve of nodes that are held; empty: none
  std::string contact{};              ///< curve of contact candidates; empty: none
  std::vector<std::string> curves{};  ///< further ones that must exist, each a part of the boundary
  std::vector<std::string> surfaces{};  ///< further ones that must exist
};

struct ReadMesh {
  Mesh mesh;
  std::vector<std::string> warnings;  ///< for the user, one line each
};

/// Numbering: nodes by their tags in the file, cells by surface, kind and tag. `boundary`: open
/// lines of the contact curve first, then closed ones, each with the body on its left; nodes that
/// are clamped are left out, and contact_edges are those between nodes that remain. `tributary`
/// counts every edge of the curve. `curves` has all physical curves of the file; an edge with cells
/// on both sides, which only a curve that is not asked for by `contact` or `curves` may have, keeps
/// its sense in the file. A node or an edge may be in several curves, a cell in one surface only.
/// Throws InputError with all faults of a kind, FileError when the file cannot be opened or the
/// program that reads it cannot be run.
ReadMesh read_gmsh(const MeshRequest& request);

}  // namespace rondo::mesh
