// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/left_behind.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rondo/core/complex.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double same_radius = 0.02;  ///< walls of grooves and inner boundaries are farther away

}  // namespace

LeftBehind::LeftBehind(std::span<const Vec2> place) : order_(place.size()), rank_(place.size()) {
  const auto angle = [&](int node) { return std::atan2(place[at(node)].y, place[at(node)].x); };
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::stable_sort(order_, {}, angle);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    angle_.push_back(angle(order_[i]));
    radius_.push_back(norm(place[at(order_[i])]));
    rank_[at(order_[i])] = static_cast<int>(i);
  }
  shares_.reserve(2 * place.size());
}

void LeftBehind::add(int node, Vec2 force, double turn) {
  const Vec2 own = rotation(-turn) * force;
  const double back = std::remainder(-turn, full_turn);  // from the node, seen by the body
  const int step = back < 0.0 ? -1 : 1, own_rank = rank_[at(node)];
  int near = own_rank;  // the last one that was passed
  double passed = 0.0;  // from the node to `near`
  while (true) {
    const int next = next_as_far_out(near, step, radius_[at(own_rank)]);
    double gap = step * (angle_[at(next)] - angle_[at(near)]);
    if (gap < 0.0) gap += full_turn;
    if (passed + gap >= std::abs(back) || next == own_rank) {
      const double share = gap > 0.0 ? std::min(1.0, (std::abs(back) - passed) / gap) : 0.0;
      shares_.push_back({order_[at(near)], (1.0 - share) * own});
      if (share > 0.0) shares_.push_back({order_[at(next)], share * own});
      return;
    }
    passed += gap;
    near = next;
  }
}

/// The next one in the order, of a radius that some node has.
int LeftBehind::next_as_far_out(int rank, int step, double radius) const {
  const int n = static_cast<int>(order_.size());
  do rank = (rank + step + n) % n;
  while (std::abs(radius_[at(rank)] - radius) > same_radius * radius);
  return rank;
}

}  // namespace rondo::rom
