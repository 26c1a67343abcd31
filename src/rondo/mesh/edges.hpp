// SPDX-License-Identifier: BSD-3-Clause
/// @file  The edges of a mesh's cells, found by their nodes in constant time.
#pragma once
#include <span>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// An edge as one cell sees it.
struct CellEdge {
  int high = 0;         ///< the larger of its node numbers
  int cell = 0;         ///< place in Mesh::cells
  bool rising = false;  ///< the cell runs through it from the smaller number to the larger
};

/// Sorted by the smaller node number, then the larger, then the cell.
class EdgeTable {
 public:
  /// Time and memory in proportion to the cells. @pre every corner is a node of the mesh
  explicit EdgeTable(const Mesh& mesh);

  /// What the cells on either side say of an edge: none, one (boundary), two (inside), or more.
  [[nodiscard]] std::span<const CellEdge> find(Edge edge) const;

  /// Every edge once: visit(smaller node, its cells).
  template <class Visit>
  void each(const Visit& visit) const {
    for (std::size_t low = 0; low + 1 < first_.size(); ++low)
      for (std::size_t k = first_[low]; k < first_[low + 1];) {
        const std::size_t begin = k;
        while (k < first_[low + 1] && edges_[k].high == edges_[begin].high) ++k;
        visit(static_cast<int>(low), std::span(edges_).subspan(begin, k - begin));
      }
  }

 private:
  std::vector<std::size_t> first_;  ///< (n + 1) where the edges of a smaller node begin
  std::vector<CellEdge> edges_;
};

/// Edges of one cell only, the body on the left; in the table's order.
std::vector<Edge> boundary_edges(const EdgeTable& table);

/// (n) 1 at the nodes of the boundary.
std::vector<char> boundary_flags(const EdgeTable& table, std::size_t n_nodes);

/// Length of the longest edge, 0 where there is none [m]. @param x (n) places of the nodes
double longest_edge(std::span<const Vec2> x, std::span<const Edge> edges);

/// Edges one after the other, as they follow each other: open lines first, then closed ones, each
/// by the number of its first node; a closed one begins at its smallest number. @pre no edge twice
std::vector<Edge> in_order(std::span<const Edge> edges);

}  // namespace rondo::mesh
