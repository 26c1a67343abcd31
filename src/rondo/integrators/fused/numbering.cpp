// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/numbering.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/fused/kernels/kernels.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;

std::size_t row_length(const fem::BlockCsr& k, int node) noexcept {
  const auto row = static_cast<std::size_t>(node);
  return static_cast<std::size_t>(k.row_start[row + 1] - k.row_start[row]);
}

/// The blocks of a node's row, from a place on.
void put_row(const fem::BlockCsr& k, int node, std::span<const int> row, std::size_t place,
             RowPacks& packs) {
  const auto of = static_cast<std::size_t>(node);
  for (auto at = k.row_start[of]; at < k.row_start[of + 1]; ++at, place += lanes) {
    const auto b = static_cast<std::size_t>(at);
    const auto [xx, yx, xy, yy] = k.values[b];
    RONDO_ASSERT(row[static_cast<std::size_t>(k.column[b])] >= 0, node, k.column[b]);
    packs.column.data()[place] = 2 * row[static_cast<std::size_t>(k.column[b])];
    std::ranges::copy(std::array{xx, xy, yx, yy}, packs.blocks.data() + 4 * place);
  }
}

std::span<const std::int32_t> neighbours(const fem::BlockCsr& k, int node) noexcept {
  const auto row = static_cast<std::size_t>(node);
  const auto first = static_cast<std::size_t>(k.row_start[row]);
  const auto last = static_cast<std::size_t>(k.row_start[row + 1]);
  return std::span(k.column).subspan(first, last - first);
}

/// Walks over the graph of K, and the order they leave.
class Walker {
 public:
  Walker(const fem::BlockCsr& k, std::size_t n_nodes) : k_(k), last_walk_(k.n_rows(), 0) {
    order_.reserve(n_nodes);
  }

  [[nodiscard]] bool in_order(int node) const { return last_walk(node) == walk_kept; }

  /// Puts the part that a node is of behind the others.
  void add_part(int node) {
    const std::size_t first = order_.size();
    End end = far_end(node);
    for (End next = far_end(end.node); next.depth > end.depth; next = far_end(end.node)) {
      node = end.node;
      end = next;
    }
    walk(node, first, walk_kept);
  }

  [[nodiscard]] std::vector<int> take_order() { return std::move(order_); }

 private:
  /// A node of few neighbours as far from where the walk began as any.
  struct End {
    int node, depth;
  };
  static constexpr int walk_kept = -1;

  int& last_walk(int node) { return last_walk_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] int last_walk(int node) const { return last_walk_[static_cast<std::size_t>(node)]; }

  /// Nodes of the order from place `from` on, those of few neighbours first.
  void sort_from(std::size_t from) {
    std::stable_sort(
        order_.begin() + static_cast<std::ptrdiff_t>(from), order_.end(),
        [&](int a, int b) { return neighbours(k_, a).size() < neighbours(k_, b).size(); });
  }

  /// Breadth first over all that `start` reaches, which the order gets from place `first` on.
  /// Returns where the last level begins and how many levels there are.
  std::pair<std::size_t, int> walk(int start, std::size_t first, int number) {
    order_.resize(first);
    order_.push_back(start);
    last_walk(start) = number;
    std::size_t level = first;
    int depth = 0;
    for (std::size_t next = first; next < order_.size(); ++depth) {
      level = next;
      for (const std::size_t end = order_.size(); next < end; ++next) {
        const std::size_t from = order_.size();
        for (const int other : neighbours(k_, order_[next])) {
          if (last_walk(other) == number) continue;
          last_walk(other) = number;
          order_.push_back(other);
        }
        sort_from(from);
      }
    }
    return {level, depth};
  }

  End far_end(int start) {
    const std::size_t first = order_.size();
    const auto [level, depth] = walk(start, first, ++walks_);
    sort_from(level);
    const End end{order_[level], depth};
    order_.resize(first);
    return end;
  }

  const fem::BlockCsr& k_;
  std::vector<int> last_walk_;  ///< (n) number of the walk that came to a node last
  int walks_ = 0;
  std::vector<int> order_;
};

}  // namespace

Bandwidth bandwidth(const fem::BlockCsr& k, std::span<const int> order) {
  std::vector<int> place(k.n_rows(), 0);
  for (std::size_t i = 0; i < order.size(); ++i)
    place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  Bandwidth b;
  double sum = 0.0, n = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (const int other : neighbours(k, order[i])) {
      const int distance = std::abs(static_cast<int>(i) - place[static_cast<std::size_t>(other)]);
      b.maximum = std::max(b.maximum, distance);
      sum += distance;
      n += 1.0;
    }
  if (n > 0.0) b.mean = sum / n;
  return b;
}

std::vector<int> reverse_cuthill_mckee(const fem::BlockCsr& k, std::span<const int> nodes) {
  Walker walker(k, nodes.size());
  for (const int node : nodes)
    if (!walker.in_order(node)) walker.add_part(node);
  std::vector<int> order = walker.take_order();
  RONDO_DEMAND(order.size() == nodes.size(), order.size(), nodes.size());  // couple with no others
  std::reverse(order.begin(), order.end());
  return order;
}

std::vector<int> row_order(const fem::BlockCsr& k, std::span<const int> nodes) {
  std::vector<int> other = reverse_cuthill_mckee(k, nodes);
  if (bandwidth(k, other).mean < bandwidth(k, nodes).mean) return other;
  return {nodes.begin(), nodes.end()};
}

void sort_by_length(const fem::BlockCsr& k, std::vector<int>& order) {
  constexpr std::size_t window = 8 * lanes;  // whole packs
  for (std::size_t i = 0; i < order.size(); i += window) {
    const std::span rows = std::span(order).subspan(i, std::min(window, order.size() - i));
    std::stable_sort(rows.begin(), rows.end(),
                     [&](int a, int b) { return row_length(k, a) > row_length(k, b); });
  }
}

RowPacks make_row_packs(const fem::BlockCsr& k, std::span<const int> node, std::size_t n_packs,
                        std::span<const int> row) {
  RONDO_DEMAND(row.size() == k.n_rows() && node.size() <= n_packs * lanes, row.size(), k.n_rows(),
               node.size(), n_packs);
  const auto is_padding = [&](std::size_t i) { return i >= node.size() || node[i] < 0; };
  RowPacks packs;
  packs.start.assign(1, 0);
  for (std::size_t i = 0; i < n_packs * lanes; i += lanes) {
    const std::size_t length = is_padding(i) ? 0 : row_length(k, node[i]);
    packs.start.push_back(packs.start.back() + static_cast<std::int64_t>(length));
  }
  const std::size_t n = static_cast<std::size_t>(packs.start.back()) * lanes;
  packs.blocks = LargeArray(4 * n);
  packs.column = LargeArrayOf<std::int32_t>(n);
  for (std::size_t i = 0; i < n_packs * lanes; ++i) {
    const auto first = static_cast<std::size_t>(packs.start[i / lanes]);
    const auto last = static_cast<std::size_t>(packs.start[i / lanes + 1]);
    for (std::size_t at = first; at < last; ++at)
      packs.column.data()[at * lanes + i % lanes] = static_cast<std::int32_t>(2 * i);
    RONDO_ASSERT(is_padding(i) || row_length(k, node[i]) <= last - first, node[i], last - first);
    if (!is_padding(i)) put_row(k, node[i], row, first * lanes + i % lanes, packs);
  }
  return packs;
}

}  // namespace rondo::dynamics
