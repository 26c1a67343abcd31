// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/edges.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "rondo/core/index.hpp"

namespace rondo::mesh {
namespace {

Edge edge_of(const Cell& cell, int corner) {
  const int next = (corner + 1) % n_corners(cell);
  return {cell[at(corner)], cell[at(next)]};
}

}  // namespace

EdgeTable::EdgeTable(const Mesh& mesh) : first_(mesh.n_nodes() + 1, 0) {
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < n_corners(cell); ++a)
      ++first_[static_cast<std::size_t>(std::ranges::min(edge_of(cell, a))) + 1];
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  edges_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    for (int a = 0; a < n_corners(mesh.cells[e]); ++a) {
      const auto [from, to] = edge_of(mesh.cells[e], a);
      edges_[next[at(std::min(from, to))]++] = {std::max(from, to), static_cast<int>(e), from < to};
    }
  const auto edge = [&](std::size_t k) { return edges_.begin() + static_cast<std::ptrdiff_t>(k); };
  for (std::size_t k = 0; k + 1 < first_.size(); ++k)
    std::sort(edge(first_[k]), edge(first_[k + 1]), [](const CellEdge& a, const CellEdge& b) {
      return std::tie(a.high, a.cell) < std::tie(b.high, b.cell);
    });
}

std::span<const CellEdge> EdgeTable::find(Edge edge) const {
  const auto low = static_cast<std::size_t>(std::ranges::min(edge));
  const auto all = std::span(edges_).subspan(first_[low], first_[low + 1] - first_[low]);
  const int high = std::ranges::max(edge);
  return {std::ranges::lower_bound(all, high, {}, &CellEdge::high),
          std::ranges::upper_bound(all, high, {}, &CellEdge::high)};
}

std::vector<Edge> boundary_edges(const EdgeTable& table) {
  std::vector<Edge> edges;
  table.each([&](int low, std::span<const CellEdge> cells) {
    if (cells.size() != 1) return;
    const int high = cells.front().high;
    edges.push_back(cells.front().rising ? Edge{low, high} : Edge{high, low});
  });
  return edges;
}

std::vector<char> boundary_flags(const EdgeTable& table, std::size_t n_nodes) {
  std::vector<char> flags(n_nodes, 0);
  for (const Edge& edge : boundary_edges(table))
    for (const int node : edge) flags[at(node)] = 1;
  return flags;
}

double longest_edge(std::span<const Vec2> x, std::span<const Edge> edges) {
  double longest = 0.0;
  for (const Edge& edge : edges) longest = std::max(longest, norm(x[at(edge[1])] - x[at(edge[0])]));
  return longest;
}

std::vector<Edge> in_order(std::span<const Edge> edges) {
  std::vector<Edge> sorted(edges.begin(), edges.end());
  std::ranges::sort(sorted);
  std::vector<int> ends;
  for (const Edge& edge : sorted) ends.push_back(edge[1]);
  std::ranges::sort(ends);
  std::vector<char> used(sorted.size(), 0);
  std::vector<std::size_t> unused(sorted.size());  // of the edges that begin at the same node
  std::iota(unused.begin(), unused.end(), std::size_t{0});
  std::vector<Edge> ordered;
  ordered.reserve(sorted.size());
  const auto begins_at = [&](std::size_t k, int node) {
    return k < sorted.size() && sorted[k][0] == node;
  };
  const auto follow = [&](std::size_t k) {
    while (true) {
      used[k] = 1;
      ordered.push_back(sorted[k]);
      const int node = sorted[k][1];
      const auto group = std::ranges::lower_bound(sorted, Edge{node, 0}) - sorted.begin();
      if (!begins_at(static_cast<std::size_t>(group), node)) return;
      std::size_t& next = unused[at(group)];
      while (begins_at(next, node) && used[next]) ++next;
      if (!begins_at(next, node)) return;
      k = next;
    }
  };
  for (const bool closed : {false, true})
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      if (used[k]) continue;
      const bool has_before = std::ranges::binary_search(ends, sorted[k][0]);
      if (closed || !has_before) follow(k);
    }
  return ordered;
}

}  // namespace rondo::mesh
