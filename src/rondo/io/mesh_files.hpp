// SPDX-License-Identifier: BSD-3-Clause
/// @file  The group /mesh of an HDF5 file (docs/results.md) and its cells in the form XDMF needs.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/io/h5/h5.hpp"
#include "rondo/io/xdmf.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::io {

/// @param mass (n) lumped mass per unit thickness [kg/m], in three dimensions mass [kg].
/// @throws FileError
void write_mesh(h5::File& file, const mesh::Mesh& mesh, std::span<const double> mass);

struct MeshWithMass {
  mesh::Mesh mesh;           ///< without `clamped`, which is not stored
  std::vector<double> mass;  ///< (n) lumped mass per unit thickness [kg/m]; solid: mass [kg]
};

/// @throws FileError: no mesh, or an invalid one
MeshWithMass read_mesh(const h5::File& file);

/// Empty if both are bitwise the same in all that is stored; else the first difference.
std::string mesh_difference(const mesh::Mesh& a, const mesh::Mesh& b);

/// Hash of everything in the mesh except names; equal if two meshes are bitwise the same.
std::string mesh_hash(const mesh::Mesh& mesh);

/// Size in bytes of the datasets of write_mesh().
std::size_t mesh_bytes(const mesh::Mesh& mesh) noexcept;

/// The cells of a mesh that write_mesh() wrote.
XdmfTopology topology_of(const mesh::Mesh& mesh);

}  // namespace rondo::io
