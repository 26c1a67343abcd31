// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/box_tree.hpp"

#include <cmath>

namespace rondo::contact {
namespace {

using Box = BoxTree::Box;

Box around(std::span<const Box> boxes) {
  Box out = boxes.front();
  for (const Box& box : boxes.subspan(1)) {
    out.low = {std::min(out.low.x, box.low.x), std::min(out.low.y, box.low.y)};
    out.high = {std::max(out.high.x, box.high.x), std::max(out.high.y, box.high.y)};
  }
  return out;
}

std::vector<Box> runs_of(std::span<const Box> boxes, std::size_t size) {
  std::vector<Box> runs;
  for (std::size_t first = 0; first < boxes.size(); first += size)
    runs.push_back(around(boxes.subspan(first, std::min(size, boxes.size() - first))));
  return runs;
}

/// Largest coordinate that is finite.
double largest_of(std::span<const Box> boxes) {
  double largest = 0.0;
  for (const Box& box : boxes)
    for (const double coordinate : {box.low.x, box.low.y, box.high.x, box.high.y})
      if (std::isfinite(coordinate)) largest = std::max(largest, std::abs(coordinate));
  return largest;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> pieces)
    : n_pieces_(pieces.size()), round_off_(1e-12 * largest_of(pieces)) {
  if (pieces.empty()) return;
  levels_.push_back(runs_of(pieces, pieces_of_leaf));
  while (levels_.back().size() > 1) levels_.push_back(runs_of(levels_.back(), 2));
}

}  // namespace rondo::contact
