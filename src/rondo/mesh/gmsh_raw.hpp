// SPDX-License-Identifier: BSD-3-Clause
/// @file  A Gmsh file as the Gmsh library gives it, with the file's own numbers ("tags").
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rondo::mesh {

struct RawType {
  int type = 0;  ///< Gmsh's number: 1 line, 2 triangle, 3 quadrilateral, 15 point
  int dimension = 0;
  int order = 0;
  int n_nodes = 0;
  std::string name;
};

struct RawGroup {
  int dimension = 0;
  int tag = 0;
  std::string name;  ///< may be empty
};

/// A point, curve, surface or volume of the geometry.
struct RawEntity {
  int dimension = 0;
  int tag = 0;
  std::vector<int> groups;  ///< tags of its physical groups
};

/// The elements of one type on one entity.
struct RawBlock {
  std::size_t entity = 0;            ///< index in RawMesh::entities
  std::size_t type = 0;              ///< index in RawMesh::types
  std::vector<std::uint64_t> tags;   ///< (m)
  std::vector<std::uint64_t> nodes;  ///< (m, nodes per element) tags
};

/// Counts and indices of entities and types are checked; tags of nodes are those of the file.
struct RawMesh {
  std::uint64_t nodes_in_file = 0;    ///< 0: unknown
  std::vector<std::string> warnings;  ///< for the user, one line each
  std::vector<RawType> types;
  std::vector<RawGroup> groups;
  std::vector<RawEntity> entities;
  std::vector<std::uint64_t> node_tags;  ///< (n)
  std::vector<double> places;            ///< (n, 3) in the file's unit of length
  std::vector<RawBlock> blocks;
};

/// The stream of rondo-mesh-reader ended early or does not have the form of such a stream.
struct BadStream {
  bool ended = false;
};

/// A mesh, or the reason why there is none.
struct RawStream {
  std::optional<RawMesh> mesh;
  std::string why;
};

/// Reads up to `size` bytes into `data`; @return the number of bytes read, 0: end.
using ReadBytes = std::function<std::size_t(void* data, std::size_t size)>;

/// Reads what gmsh_stream.hpp describes. The stream is not trusted: a count is accepted only if a
/// file of `file_bytes` can hold as many items. Throws BadStream.
RawStream read_stream(const ReadBytes& read, std::uint64_t file_bytes);

/// Starts rondo-mesh-reader on a file and reads what it writes. The program is the one named by the
/// environment variable RONDO_MESH_READER, or the one beside the running program, or the installed
/// one. Throws InputError if the cause is the file, FileError if it is the machine.
/// @pre the file can be read
RawMesh read_raw_mesh(const std::filesystem::path& file, std::uint64_t file_bytes);

}  // namespace rondo::mesh
