// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps from a raw Gmsh file to a mesh; each step adds the faults that it finds.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/gmsh_raw.hpp"
#include "rondo/mesh/gmsh_reader.hpp"

namespace rondo::mesh {

/// Faults, and warnings that do not prevent reading.
struct Findings {
  std::string file;
  std::vector<Fault> faults;
  std::vector<std::string> warnings;

  void add(std::string message, std::string allowed);
  void throw_if_faulty();
};

/// "a, b, c and 4 more": the first five of `count` things, text_of(k) of each.
template <class TextOf>
std::string examples(std::size_t count, const TextOf& text_of) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t k = 0; k < std::min(count, most); ++k)
    text += (k == 0 ? "" : ", ") + std::string(text_of(k));
  if (count > most) text += fmt::format(" and {} more", count - most);
  return text;
}

// The file ------------------------------------------------------------------------------------

struct MeshFile {
  std::uint64_t bytes = 0;
  bool version_22 = false;  ///< otherwise 4.1
};

/// Opens the file and looks at its first lines. Throws if it cannot be read.
MeshFile inspect(const std::filesystem::path& file);

/// Does all the steps below. Throws InputError.
ReadMesh mesh_of(const RawMesh& raw, bool version_22, const MeshRequest& request);

// Physical groups -----------------------------------------------------------------------------

/// The physical groups of one dimension that share one name.
struct NamedGroup {
  int dimension = 0;
  std::string name;  ///< its number if it has no name
  std::vector<int> tags;
  std::vector<std::size_t> entities;  ///< indices in RawMesh::entities
  bool empty = true;                  ///< no element is in it
};
/// The groups, ascending by dimension, then by the first tag.
std::vector<NamedGroup> named_groups(const RawMesh& raw);

/// Warns of groups that share a name, how they are read, and of surfaces without elements.
void warn_of_groups(const RawMesh& raw, const std::vector<NamedGroup>& groups, Findings& findings);

/// Adds a fault for each name of the request that the file does not have.
void check_names(const MeshRequest& request, const std::vector<NamedGroup>& groups,
                 Findings& findings);

/// nullptr: there is no such group, or the name is empty.
const NamedGroup* find_group(const std::vector<NamedGroup>& groups, int dimension,
                             std::string_view name);

// Nodes and cells -----------------------------------------------------------------------------

/// Maps the file's tags to indices in RawMesh::node_tags.
class TagIndex {
 public:
  explicit TagIndex(const std::vector<std::uint64_t>& tags);
  /// -1: no node has the tag.
  [[nodiscard]] int find(std::uint64_t tag) const;
  /// Tags that more than one node has.
  [[nodiscard]] const std::vector<std::uint64_t>& repeated() const { return repeated_; }

 private:
  std::vector<std::pair<std::uint64_t, int>> sorted_;
  std::vector<int> dense_;  ///< index by tag, used if there are few gaps
  std::vector<std::uint64_t> repeated_;
};

/// A mesh in the making, with the numbers that the file gives its nodes and cells.
struct Draft {
  double scale = 1.0;
  Mesh mesh;
  std::vector<std::uint64_t> node_tag;   ///< (n)
  std::vector<std::uint64_t> cell_tag;   ///< (e)
  std::vector<std::size_t> cell_entity;  ///< (e) index in RawMesh::entities
  std::vector<int> node_of;              ///< index in RawMesh::node_tags -> node; -1: dropped

  /// "element 12 at (0.5, 1)", "node 3 at (0, 0)": positions in the file's unit of length.
  [[nodiscard]] std::string cell_text(int cell) const;
  [[nodiscard]] std::string node_text(int node) const;
  [[nodiscard]] std::string place_text(Vec2 x) const;
};

/// Adds a fault for types of elements that cannot be read.
void check_types(const RawMesh& raw, const TagIndex& index, Findings& findings);

/// Makes the nodes and cells of the mesh.
Draft draft_mesh(const RawMesh& raw, const TagIndex& index, const MeshRequest& request,
                 Findings& findings);

/// Checks shape and sense of the cells; reverses all of them if all are clockwise.
void check_shapes(const RawMesh& raw, Draft& draft, Findings& findings);

/// Checks for duplicate cells, folded meshes and coincident nodes. @pre cells of good shape
void check_joints(const Draft& draft, const EdgeTable& table, Findings& findings);

// Regions and curves --------------------------------------------------------------------------

void add_regions(const RawMesh& raw, const std::vector<NamedGroup>& groups, Draft& draft,
                 Findings& findings);

struct CurveInput {
  const RawMesh& raw;
  const TagIndex& index;
  const std::vector<NamedGroup>& groups;
  const EdgeTable& table;
  const MeshRequest& request;
  bool version_22 = false;
};
void add_curves(const CurveInput& in, Draft& draft, Findings& findings);

/// Adds clamped nodes and contact candidates. @pre add_curves found no fault
void add_boundary(const CurveInput& in, Draft& draft, Findings& findings);

}  // namespace rondo::mesh
