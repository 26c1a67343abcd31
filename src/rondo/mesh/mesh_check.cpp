// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/mesh_check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "rondo/core/index.hpp"

namespace rondo::mesh {
namespace {

/// Relative to the squared longest edge. It is well above the rounding of coordinates some 10⁴
/// element sizes away from zero, and well below the thinnest element that a step tolerates.
constexpr double flat = 1e-10;

struct Corners {
  std::array<Vec2, 4> x;
  std::size_t n = 0;
};

Corners corners_of(const Mesh& mesh, const Cell& cell) {
  Corners corners;
  corners.n = static_cast<std::size_t>(n_corners(cell));
  for (std::size_t a = 0; a < corners.n; ++a) corners.x[a] = mesh.coordinates[at(cell[a])];
  return corners;
}

bool has_repeated_node(const Cell& cell) {
  const auto n = static_cast<std::size_t>(n_corners(cell));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (cell[a] == cell[b]) return true;
  return false;
}

using CellKey = std::array<int, 4>;

CellKey key_of(const Cell& cell) {
  CellKey key = cell;
  std::ranges::sort(key);  // -1 first: a triangle is never a duplicate of a quadrilateral
  return key;
}

int smallest_node(const Cell& cell) {
  return *std::min_element(cell.begin(), cell.begin() + n_corners(cell));
}

/// Squares of a grid, each with the first node found in it; a hash table with open addressing.
class Squares {
 public:
  explicit Squares(std::size_t n) : slots_(std::bit_ceil(2 * n + 1)) {}

  /// @return the node that was in the square before; -1: none, and `node` is stored
  int enter(std::int64_t x, std::int64_t y, int node) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t k = mixed(x, y) & mask;; k = (k + 1) & mask) {
      Slot& slot = slots_[k];
      if (slot.node < 0) {
        slot = {x, y, node};
        return -1;
      }
      if (slot.x == x && slot.y == y) return slot.node;
    }
  }

 private:
  struct Slot {
    std::int64_t x = 0, y = 0;
    int node = -1;
  };

  static std::size_t mixed(std::int64_t x, std::int64_t y) {
    // Odd multipliers spread the bits (2^64 over the golden ratio); the high bits are best mixed.
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;
    std::uint64_t h = static_cast<std::uint64_t>(x) * golden;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(y)) * golden;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }

  std::vector<Slot> slots_;
};

}  // namespace

CellShape cell_shape(const Mesh& mesh, const Cell& cell) {
  if (has_repeated_node(cell)) return CellShape::repeated;
  const auto [x, n] = corners_of(mesh, cell);
  double twice_area = 0.0, smallest = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (std::size_t a = 0; a < n; ++a) {
    const Vec2 ahead = x[(a + 1) % n] - x[a], behind = x[(a + n - 1) % n] - x[a];
    twice_area += cross(x[a] - x[0], x[(a + 1) % n] - x[0]);
    smallest = std::min(smallest, cross(ahead, behind));
    longest = std::max(longest, dot(ahead, ahead));
  }
  if (std::abs(twice_area) <= flat * longest) return CellShape::flat;
  if (twice_area < 0.0) return CellShape::clockwise;
  return smallest > flat * longest ? CellShape::good : CellShape::concave;
}

BadCells check_cells(const Mesh& mesh) {
  BadCells bad;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const int number = static_cast<int>(e);
    switch (cell_shape(mesh, mesh.cells[e])) {
      case CellShape::good:
        break;
      case CellShape::repeated:
        bad.repeated.push_back(number);
        break;
      case CellShape::flat:
        bad.flat.push_back(number);
        break;
      case CellShape::clockwise:
        bad.clockwise.push_back(number);
        break;
      case CellShape::concave:
        bad.concave.push_back(number);
        break;
    }
  }
  return bad;
}

Cell reversed(const Cell& cell) {
  if (cell[3] < 0) return {cell[0], cell[2], cell[1], -1};
  return {cell[0], cell[3], cell[2], cell[1]};
}

std::vector<std::array<int, 2>> duplicate_cells(const Mesh& mesh) {
  std::vector<std::size_t> first(mesh.n_nodes() + 1, 0);
  const auto low = [&](std::size_t e) {
    return static_cast<std::size_t>(smallest_node(mesh.cells[e]));
  };
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) ++first[low(e) + 1];
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  std::vector<std::pair<CellKey, int>> entries(mesh.cells.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    entries[next[low(e)]++] = {key_of(mesh.cells[e]), static_cast<int>(e)};
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t k = 0; k + 1 < first.size(); ++k) {
    const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(first[k]);
    const auto end = entries.begin() + static_cast<std::ptrdiff_t>(first[k + 1]);
    std::sort(begin, end);
    for (auto at = begin; at != end; ++at)
      if (at != begin && at->first == (at - 1)->first)
        pairs.push_back({at->second, (at - 1)->second});
  }
  return pairs;
}

std::vector<BadEdge> crowded_edges(const EdgeTable& table) {
  std::vector<BadEdge> crowded;
  table.each([&](int low, std::span<const CellEdge> cells) {
    if (cells.size() < 2 || (cells.size() == 2 && cells[0].rising != cells[1].rising)) return;
    BadEdge edge{{low, cells.front().high}, {}};
    for (const CellEdge& cell : cells) edge.cells.push_back(cell.cell);
    crowded.push_back(std::move(edge));
  });
  return crowded;
}

std::vector<std::array<int, 2>> coincident_nodes(const Mesh& mesh) {
  if (mesh.n_nodes() == 0) return {};
  Vec2 low = mesh.coordinates.front(), high = low;
  for (const Vec2 x : mesh.coordinates) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y)};
  }
  const double side = 2e-9 * std::max(high.x - low.x, high.y - low.y);
  if (!(side > 0.0)) return {};
  // Two nodes that are within half a side of each other, in x and in y, share a square in at least
  // one of four grids shifted by half a side.
  std::vector<int> earlier(mesh.n_nodes(), -1);
  for (const Vec2 shift : {Vec2{0.0, 0.0}, Vec2{0.5, 0.0}, Vec2{0.0, 0.5}, Vec2{0.5, 0.5}}) {
    Squares squares(mesh.n_nodes());
    for (std::size_t k = 0; k < mesh.n_nodes(); ++k) {
      const Vec2 place = (mesh.coordinates[k] - low) / side + shift;
      const int before =
          squares.enter(static_cast<std::int64_t>(std::floor(place.x)),
                        static_cast<std::int64_t>(std::floor(place.y)), static_cast<int>(k));
      if (before >= 0 && earlier[k] < 0) earlier[k] = before;
    }
  }
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t k = 0; k < mesh.n_nodes(); ++k)
    if (earlier[k] >= 0) pairs.push_back({static_cast<int>(k), earlier[k]});
  return pairs;
}

}  // namespace rondo::mesh
