// SPDX-License-Identifier: BSD-3-Clause
/// @file  Counts the declared contents of a Gmsh file without the Gmsh library, which reads many
/// inconsistent files as smaller meshes (MSH 2.2 and 4.1: https://gmsh.info/doc/texinfo).
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace rondo::reader {

/// Dimension and tag of a point, curve, surface or volume of the geometry, or of a physical group.
using Id = std::pair<int, int>;

/// Size of the elements of one type.
struct TypeShape {
  int dimension = 0, n_nodes = 0;
};
/// Takes Gmsh's number of a type; returns {0, 0} if there is no such type.
using ShapeOf = std::function<TypeShape(int type)>;

struct Census {
  std::string version;
  std::map<Id, std::string> names;  ///< of physical groups
  std::uint64_t n_nodes = 0;
  std::map<std::tuple<int, int, int>, std::uint64_t> elements;  ///< by dimension, entity, type
  std::map<Id, std::set<int>> groups;  ///< physical tags of each entity, without their signs
  int n_parts = 0;                     ///< 0: the mesh is not partitioned
  std::set<Id> ghosts;         ///< entities whose elements are copies of those of other parts
  std::set<Id> between_parts;  ///< curves and points between parts: not in the geometry
};

/// Throws std::string: the contradiction and its line.
Census take_census(std::string_view text, const ShapeOf& shape_of);

}  // namespace rondo::reader
