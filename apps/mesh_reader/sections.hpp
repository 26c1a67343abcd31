// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sections of Gmsh files of both versions, used by census.cpp.
#pragma once
#include "census.hpp"
#include "scanner.hpp"

namespace rondo::reader {

/// Tags of nodes or of elements, which must be unique.
class Tags {
 public:
  void add(std::uint64_t tag);
  /// Throws std::string if a tag occurs twice. @param what "nodes"
  void demand_unique(const std::string& what);

 private:
  std::vector<std::uint64_t> tags_;
  bool ascending_ = true;
};

/// The state of a census while it is made.
struct Counting {
  Scanner& in;
  const ShapeOf& shape_of;
  Census& census;
  std::map<int, TypeShape> shapes{};
  std::map<Id, std::vector<int>> parts{};  ///< MSH 4.1: of partitioned entities

  /// Shape of a type of elements; fails if the type has no nodes.
  TypeShape shape(int type);
};

/// The number of a physical group without its sign (negative: the group reverses the element).
int magnitude(Counting& c, int physical);
void count_nodes_22(Counting& c);
void count_elements_22(Counting& c);
void count_entities_41(Counting& c);
void count_parts_41(Counting& c);
void count_nodes_41(Counting& c);
void count_elements_41(Counting& c);
/// Fails if a part of the mesh is missing.
void demand_all_parts(const Counting& c);

}  // namespace rondo::reader
