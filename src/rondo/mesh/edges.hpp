// SPDX-License-Identifier: BSD-3-Clause
/// @file  The edges of a mesh's cells, found by their nodes in constant time.
#pragma once
#include <span>
#include <vector>

#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

/// An edge as seen from one cell.
struct CellEdge {
  int high = 0;         ///< the larger of its node numbers
  int cell = 0;         ///< index in Mesh::cells
  bool rising = false;  ///< the cell passes it from the smaller to the larger node number
};

/// All edges, sorted by the smaller node number, then by the larger, then by the cell.
class EdgeTable {
 public:
  /// Time and memory grow linearly with the cells. @pre every corner is a node of the mesh
  explicit EdgeTable(const Mesh& mesh);

  /// The entries of an edge, one per cell that has it: none, one (boundary), two (inside), or more.
  [[nodiscard]] std::span<const CellEdge> find(Edge edge) const;

  /// Visits every edge once: visit(smaller node, its entries, one per cell).
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
  std::vector<std::size_t> first_;  ///< (n + 1) index of the first edge with this smaller node
  std::vector<CellEdge> edges_;
};

/// Edges that only one cell has, with the body on the left, in the order of the table.
std::vector<Edge> boundary_edges(const EdgeTable& table);

/// (n) 1 at nodes of the boundary.
std::vector<char> boundary_flags(const EdgeTable& table, std::size_t n_nodes);

/// Length of the longest edge, 0 if there is none [m]. @param x (n) positions of the nodes
double longest_edge(std::span<const Vec2> x, std::span<const Edge> edges);

/// The edges arranged so that each follows its predecessor: open lines first, then closed ones,
/// both ordered by their first node; a closed line begins at its smallest node. @pre no edge twice
std::vector<Edge> in_order(std::span<const Edge> edges);

}  // namespace rondo::mesh
