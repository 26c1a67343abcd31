// SPDX-License-Identifier: BSD-3-Clause
/// Friction that depends on slip, pressure and place (docs/reduced.md).
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

constexpr int most_tangents = 12;     ///< in a step
constexpr double settled_law = 1e-9;  ///< change of what friction holds, over the largest force

void count(const GapLaw::Report& solved, WheelReport& report) {
  report.iterations += solved.iterations;
  report.second_method |= solved.pivoted;
  report.law_residual = solved.residual;
}

}  // namespace

/// Place of a node at the start of the step [m].
Vec2 RingWheel::place_before(const Near& near, const WheelMotion& m) const {
  const Memory& was = memory_of(near.node);
  return was.known > 0 ? m.center + was.place[0] : m.center_next + near.place;
}

/// μ of a candidate by the step before.
double RingWheel::friction_of(std::size_t candidate, const WheelMotion& m) const {
  if (!sliding_) return friction_.constant();
  const Near& near = near_[solved_[candidate]];
  return sliding_->before(near.node, place_before(near, m), tangent_of(touch_[candidate].normal));
}

/// μ of all candidates at their slips and forces, with its derivatives. @return the largest
/// change of what friction holds, over the largest force
double RingWheel::take_tangents(const WheelMotion& m) {
  double largest = 0.0, change = 0.0;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    GapContact& c = law_[i];
    const bool slips = c.status == contact::Status::slip;
    c.slip_at = slips ? std::abs(c.slip) : 0.0;
    c.normal_at = std::max(0.0, c.normal);
    const SlidingFriction of =
        sliding_->within(near.node, place_before(near, m), c.slip_at, c.normal_at);
    const double missed = std::abs(c.shear) - of.coefficient * c.normal_at;
    change = std::max(change, slips ? std::abs(missed) : missed);
    largest = std::max(largest, c.normal);
    c.friction = of.coefficient;
    c.by_slip = of.by_slip;
    c.by_normal = of.by_normal;
  }
  return largest > 0.0 ? change / largest : 0.0;
}

/// The law with μ by the slips and the forces of the step itself, along tangents from those of the
/// step before; where they do not settle, with μ by these.
void RingWheel::solve_law(const WheelMotion& m, WheelReport& report) {
  count(gap_law_.solve(law_), report);
  report.late = false;
  if (!sliding_) return;
  law_before_ = law_;
  const double residual = report.law_residual;
  for (int i = 0; i < most_tangents; ++i) {
    if (take_tangents(m) <= settled_law) return;
    count(gap_law_.solve(law_), report);
    if (!(report.law_residual <= settled_law)) break;
  }
  law_ = law_before_;
  report.law_residual = residual;
  report.late = true;
}

/// What the friction of the next step depends on. Call before the places are those of its end.
void RingWheel::remember_sliding(const WheelMotion& m) {
  for (const int node : seen_) sliding_->keep(node, {}, 0.0);
  const Vec2 way = m.center_next - m.center;
  const Complex back = rotation(m.angle - m.angle_next);
  for (const Near& near : near_) {
    const Memory& was = memory_of(near.node);
    const Vec2 before = was.known > 0 ? was.place[0] : back * near.place;
    sliding_->keep(near.node, way + near.place - before, 0.0);
  }
  for (std::size_t i = 0; i < solved_.size(); ++i)
    if (law_[i].normal > 0.0) sliding_->press(near_[solved_[i]].node, law_[i].normal);
}

/// The ways of the nodes near the ground in a step that ends at the start, from the velocities.
void RingWheel::slide_at_start(const WheelMotion& m, std::span<const Vec2> v) {
  const double dt = settings_.dt;
  const Complex frame = rotation(m.angle_next);
  for (const Near& near : near_) {
    const std::size_t row = at(ring_.contact[at(local(near.node))]);
    const Vec2 rate = frame * v[ring_.stiffness.node(row, at(sector(near.node)))];
    const Vec2 turned = m.spin_next * turn90(near.place);
    sliding_->move(near.node, m.center_next - m.center + dt * (turned + rate));
  }
}

}  // namespace rondo::rom
