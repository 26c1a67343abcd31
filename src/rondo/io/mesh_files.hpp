// SPDX-License-Identifier: BSD-3-Clause
/// @file  The group /mesh of an HDF5 file (docs/results.md) and its cells as XDMF wants them.
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

/// @throws FileError: no mesh, or one that cannot be right
MeshWithMass read_mesh(const h5::File& file);

/// Empty if both are the same, bit by bit, but for what is not stored; else what differs first.
std::string mesh_difference(const mesh::Mesh& a, const mesh::Mesh& b);

/// Of all that the mesh holds but names, to tell whether two are the same bit by bit.
std::string mesh_hash(const mesh::Mesh& mesh);

/// Bytes of the datasets of write_mesh().
std::size_t mesh_bytes(const mesh::Mesh& mesh) noexcept;

/// Cells of a mesh written by write_mesh().
XdmfTopology topology_of(const mesh::Mesh& mesh);

}  // namespace rondo::io
