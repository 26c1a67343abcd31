// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/search.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::contact {
namespace {

Vec2 lower(Vec2 a, Vec2 b) noexcept {
  return {std::min(a.x, b.x), std::min(a.y, b.y)};
}

Vec2 upper(Vec2 a, Vec2 b) noexcept {
  return {std::max(a.x, b.x), std::max(a.y, b.y)};
}

}  // namespace

int SegmentGrid::cell_x(double x) const noexcept {
  return std::clamp(static_cast<int>((x - low_.x) * inverse_cell_), 0, columns_ - 1);
}

int SegmentGrid::cell_y(double y) const noexcept {
  return std::clamp(static_cast<int>((y - low_.y) * inverse_cell_), 0, rows_ - 1);
}

void SegmentGrid::size_cells() {
  double mean = 0.0;
  low_ = boxes_[0].low;
  high_ = boxes_[0].high;
  for (const Box& box : boxes_) {
    low_ = lower(low_, box.low);
    high_ = upper(high_, box.high);
    mean += std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  }
  const auto n = static_cast<double>(boxes_.size());
  const Vec2 size = high_ - low_;
  // Not below the mean box, nor so small that bodies far apart need cells without end.
  const double longest = std::max(size.x, size.y);
  double cell = std::max({mean / n, std::sqrt(size.x * size.y / (4.0 * n)), longest / (4.0 * n)});
  if (!(cell > 0.0)) cell = 1.0;
  inverse_cell_ = 1.0 / cell;
  columns_ = static_cast<int>(size.x * inverse_cell_) + 1;
  rows_ = static_cast<int>(size.y * inverse_cell_) + 1;
}

void SegmentGrid::fill_cells() {
  const auto each_cell = [&](const Box& box, auto&& visit) {
    const int right = cell_x(box.high.x), top = cell_y(box.high.y);
    for (int y = cell_y(box.low.y); y <= top; ++y)
      for (int x = cell_x(box.low.x); x <= right; ++x)
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
              static_cast<std::size_t>(x));
  };
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  // Counts, shifted by two: filling moves each start to where it belongs.
  cell_start_.assign(cells + 2, 0);
  for (const Box& box : boxes_) each_cell(box, [&](std::size_t c) { ++cell_start_[c + 2]; });
  for (std::size_t c = 2; c < cells + 2; ++c) cell_start_[c] += cell_start_[c - 1];
  cell_edges_.resize(static_cast<std::size_t>(cell_start_[cells + 1]));
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    each_cell(boxes_[i],
              [&](std::size_t c) { cell_edges_[at(cell_start_[c + 1]++)] = static_cast<int>(i); });
}

void SegmentGrid::build(std::span<const Vec2> positions, std::span<const std::array<int, 2>> edges,
                        double margin, double skin) {
  RONDO_DEMAND(margin >= 0.0 && skin >= 0.0, margin, skin);
  margin_ = margin;
  skin_ = skin;
  ++builds_;
  boxes_.resize(edges.size());
  built_at_.resize(2 * edges.size());
  const double reach = margin + skin;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec2 a = positions[at(edges[i][0])];
    const Vec2 b = positions[at(edges[i][1])];
    RONDO_DEMAND(std::isfinite(a.x + a.y + b.x + b.y), i);
    built_at_[2 * i] = a;
    built_at_[2 * i + 1] = b;
    boxes_[i] = {lower(a, b) - Vec2{reach, reach}, upper(a, b) + Vec2{reach, reach}};
  }
  if (edges.empty()) return;
  size_cells();
  fill_cells();
}

bool SegmentGrid::update(std::span<const Vec2> positions, std::span<const std::array<int, 2>> edges,
                         double margin, double skin) {
  bool fits =
      builds_ > 0 && built_at_.size() == 2 * edges.size() && margin == margin_ && skin == skin_;
  // A node that moves by less than the skin in x and in y stays in its box.
  for (std::size_t i = 0; fits && i < edges.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec2 moved = positions[at(edges[i][k])] - built_at_[2 * i + k];
      if (!(std::abs(moved.x) <= skin && std::abs(moved.y) <= skin)) fits = false;
    }
  if (!fits) build(positions, edges, margin, skin);
  return !fits;
}

void SegmentGrid::near(Vec2 p, std::vector<int>& edges_out) const {
  edges_out.clear();
  const bool inside = p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y;
  if (boxes_.empty() || !inside) return;
  const auto cell = static_cast<std::size_t>(cell_y(p.y)) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(cell_x(p.x));
  for (int k = cell_start_[cell]; k < cell_start_[cell + 1]; ++k) {
    const int edge = cell_edges_[at(k)];
    const Box& box = boxes_[at(edge)];
    if (p.x < box.low.x || p.x > box.high.x || p.y < box.low.y || p.y > box.high.y) continue;
    edges_out.push_back(edge);
  }
}

}  // namespace rondo::contact
