// SPDX-License-Identifier: BSD-3-Clause
/// The law on the arc in contact: statuses, elimination, forces (docs/theory.md, 3.10).
#include <cmath>
#include <utility>

#include "rondo/integrators/massless/ring_arc.hpp"

namespace rondo::dynamics {
namespace {

using contact::inverse, contact::minus, contact::sum, contact::times, contact::transposed;
using contact::Status;

constexpr int iterations_at_once = 8;  ///< on all statuses
constexpr int most_iterations = 60;

}  // namespace

/// K_cc of a node of the arc; at its ends with what lies beyond.
RingArc::Block RingArc::here_of(std::size_t i) const noexcept {
  Block here = here_;
  if (i == 0) here = sum(here, times(left_, backward_));
  if (i + 1 == arc_.size()) here = sum(here, times(right_, forward_));
  return here;
}

/// Changes from the predicted places, by the statuses at hand.
void RingArc::eliminate(double friction) {
  const double stiff = 1.0 + lag_;
  for (std::size_t i = 0; i < arc_.size(); ++i) {
    const Node& node = arc_[i];
    const bool first = i == 0, last = i + 1 == arc_.size();
    Block here = here_of(i), left = first ? Block{} : left_, right = last ? Block{} : right_;
    Vec2 load = -node.force_before / stiff;
    if (node.status == Status::stick) {
      here = {node.normal.x, node.normal.y, node.tangent.x, node.tangent.y};
      left = right = {};
      load = {-node.gap, -node.way};
    } else if (node.status == Status::slip) {
      const Vec2 w = node.tangent - node.side * friction * node.normal;
      const Vec2 h = transposed(here, w), l = transposed(left, w), r = transposed(right, w);
      here = {node.normal.x, node.normal.y, h.x, h.y};
      left = {0.0, 0.0, l.x, l.y};
      right = {0.0, 0.0, r.x, r.y};
      load = {-node.gap, dot(w, load)};
    }
    if (!first) {
      const Eliminated& before = eliminated_[i - 1];
      here = sum(here, minus(times(left, before.next)));
      load -= contact::apply(left, before.solution);
    }
    const Block inverted = inverse(here);
    eliminated_[i] = {times(inverted, right), contact::apply(inverted, load)};
  }
  Vec2 after;
  for (std::size_t i = arc_.size(); i-- > 0;)
    after = arc_[i].change = eliminated_[i].solution - contact::apply(eliminated_[i].next, after);
}

/// Finds the changes if nothing pressed the arc: its velocities without impulse are reported.
void RingArc::find_free() {
  statuses_.clear();
  for (Node& node : arc_) statuses_.push_back(std::exchange(node.status, Status::open));
  eliminate(0.0);
  for (std::size_t i = 0; i < arc_.size(); ++i) {
    arc_[i].free = arc_[i].change;
    arc_[i].status = statuses_[i];
  }
}

void RingArc::find_forces() {
  for (std::size_t i = 0; i < arc_.size(); ++i) {
    Node& node = arc_[i];
    node.force = {};
    if (node.status == Status::open) continue;
    Vec2 elastic = contact::apply(here_of(i), node.change);
    if (i > 0) elastic += contact::apply(left_, arc_[i - 1].change);
    if (i + 1 < arc_.size()) elastic += contact::apply(right_, arc_[i + 1].change);
    node.force = node.force_before + (1.0 + lag_) * elastic;
  }
}

/// The status that the law gives a node at the solution of the statuses at hand.
void RingArc::judge(Node& node, double friction) noexcept {
  const double normal = dot(node.normal, node.force), across = dot(node.tangent, node.force);
  if (node.status == Status::open) {
    if (node.gap + dot(node.normal, node.change) < closed)
      node.status = friction == 0.0 ? Status::slip : Status::stick;
  } else if (node.status == Status::stick && std::abs(across) > friction * normal) {
    node.status = Status::slip;  // before it opens: sticking may pull where slipping presses
    node.side = across < 0.0 ? -1.0 : 1.0;
  } else if (normal <= 0.0) {
    node.status = Status::open;
  } else if (node.status == Status::slip && friction > 0.0 &&
             node.side * (node.way + dot(node.tangent, node.change)) > 0.0) {
    node.status = Status::stick;
  }
}

/// All statuses at once; where that goes round in circles, the first alone that is wrong (as in
/// Murty's method). False: none is.
bool RingArc::update_statuses(double friction, bool all) noexcept {
  bool changed = false;
  for (Node& node : arc_) {
    const Status before = node.status;
    judge(node, friction);
    changed |= node.status != before;
    if (changed && !all) return true;
  }
  return changed;
}

/// A slip block that is singular leaves numbers that compare with nothing.
bool RingArc::is_finite() const noexcept {
  Vec2 sum;
  for (const Node& node : arc_) sum += node.change + node.force;
  return std::isfinite(sum.x) && std::isfinite(sum.y);
}

bool RingArc::settle(double friction) {
  for (int i = 0; i < most_iterations; ++i) {
    ++iterations_;
    eliminate(friction);
    find_forces();
    if (!update_statuses(friction, i < iterations_at_once)) return is_finite();
  }
  return false;
}

}  // namespace rondo::dynamics
