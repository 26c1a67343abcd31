// SPDX-License-Identifier: BSD-3-Clause
/// Contact of a step: nodes near the ground, the law, what its forces do.
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using contact::Status;
using Eigen::Index;

constexpr double near_share = 0.05;        ///< of the radius, above the ground: looked at
constexpr double candidate_share = 0.004;  ///< contact is solved
constexpr double closed = -1e-14;          ///< gaps above it are closed to round-off       [m]
constexpr double nothing = 1e-9;           ///< filtered forces below it are 0            [N/m]
constexpr int most_turns = 3;              ///< of the normals, on ground that is not flat

}  // namespace

/// Displacement of a contact node, in the frame of its sector. @param turn of the modes
Vec2 RingWheel::displacement(int node, Complex turn, Forces forces) const {
  const double lag = settings_.stiffness_damping / settings_.dt;
  const double filter = forces == Forces::now ? 1.0 : lag / (1.0 + lag);
  const Index c = Index{2} * local(node);
  const Index row = Index{2} * ring_.contact[at(local(node))];
  // Not a Vec2: compilers keep that in memory in these loops, and wait for it.
  double x = centrifugal_[row], y = centrifugal_[row + 1];
  if (is_whole()) {
    x += real_.contact.col(c).dot(real_.place);
    y += real_.contact.col(c + 1).dot(real_.place);
  }
  for_waves(waves_of_sectors(), turn, [&](std::size_t h, Complex wave) {
    const std::complex<double>* amplitude = modes_[h].contact.data() + c;
    const double weight = harmonics_[h].weight();
    x += weight * real_product(wave, amplitude[0]);
    y += weight * real_product(wave, amplitude[1]);
  });
  if (creep_) {
    const Vec2 u = forces == Forces::now ? creep_->now(node, shares_) : creep_->left(node, shares_);
    x += u.x;
    y += u.y;
  }
  for (const int j : active_) {
    const Block& g = beyond(node, j);
    const Vec2 force = filter * memory_of(j).filtered;
    x += g[0] * force.x + g[1] * force.y;
    y += g[2] * force.x + g[3] * force.y;
  }
  return {x, y};
}

/// Nodes that are or may come near the ground, and their places without new forces.
void RingWheel::find_near(const WheelMotion& m) {
  near_.clear();
  n_columns_ = 0;
  const double limit = ground_.top() + near_share * model_.radius - m.center_next.y;
  const Complex frame = rotation(m.angle_next), waves = rotation(waves_at(m));
  for (int node = 0, n = static_cast<int>(memory_.size()); node < n; ++node) {
    const Vec2 x = reference_[at(node)];
    if (frame.im * x.x + frame.re * x.y > limit && memory_of(node).status == Status::open) continue;
    const Complex turn = ring_.stiffness.turn[at(sector(node))];
    Near& near = near_.emplace_back();
    near.node = node;
    near.turn = frame * turn;
    near.wave = waves * turn;
    near.own_before = memory_of(node).force;
    near.free = near.place = near.turn * (arm(node) + displacement(node, near.wave, Forces::left));
  }
}

/// The distance that a node slides, as a vector, were it at its place without new forces.
Vec2 RingWheel::distance(const Near& near, const WheelMotion& m) const {
  const Memory& was = memory_of(near.node);
  const Vec2 way = m.center_next - m.center;
  if (was.known == 0)  // it comes into sight: as if it only turned
    return way + near.free - conj(rotation(m.angle_next - m.angle)) * near.free;
  if (slip_ == SlipRule::bdf2 && was.known >= 2)
    return (2.0 / 3.0) * (way + 1.5 * near.free - 2.0 * was.place[0] + 0.5 * was.place[1]);
  return was.slid(way, near.free, was.status != Status::open, bend_of(m));
}

/// Finds what forces on a near node do to the places of all of them.
void RingWheel::find_reply(Near& from) {
  if (from.column >= 0) return;
  from.column = n_columns_;
  n_columns_ += 2;
  const std::size_t rows = 2 * near_.size();
  double* by_x = reply_.data() + rows * at(from.column);
  double* by_y = by_x + rows;
  for (const Near& near : near_) {
    const contact::ComplexBlock& of = answer(near.node, from.node);
    Block w = contact::block_of({of.same, near.turn * from.turn * of.mirrored});
    if (on_moving_rim_)
      for (std::size_t k = 0; k < near.moved.size(); ++k) {
        const Vec2 a = near.moved[k], b = from.reply[k];
        w = contact::sum(w, {a.x * b.x, a.x * b.y, a.y * b.x, a.y * b.y});
      }
    *by_x++ = w[0];
    *by_x++ = w[2];
    *by_y++ = w[1];
    *by_y++ = w[3];
  }
}

/// Nodes that are low enough, or were pressed.
void RingWheel::add_candidates(const WheelMotion& m) {
  solved_.clear();
  touch_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    Near& near = near_[i];
    const contact::Touch touch = ground_.facet_near(m.center_next + near.place);
    near.candidate |=
        touch.gap < candidate_share * model_.radius || memory_of(near.node).status != Status::open;
    if (!near.candidate) continue;
    find_reply(near);
    solved_.push_back(i);
    touch_.push_back(touch);
  }
}

/// The law of the candidates, with the facets that are nearest to their places.
void RingWheel::fill_law(const WheelMotion& m) {
  const std::size_t n = solved_.size();
  law_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Near& near = near_[solved_[i]];
    const Memory& was = memory_of(near.node);
    const Vec2 normal = touch_[i].normal;
    GapContact& c = law_[i];
    c = {};
    c.free_gap = touch_[i].gap + dot(normal, near.free - near.place);
    c.free_slip = dot(tangent_of(normal), distance(near, m));
    c.status = was.status;
    c.side = was.side;
    c.friction = friction_of(i, m);
  }
  double* w = gap_law_.compliance(n).data();
  for (std::size_t j = 0; j < n; ++j, w += 4 * n) {
    const double* by_x = reply_.data() + 2 * near_.size() * at(near_[solved_[j]].column);
    const double* by_y = by_x + 2 * near_.size();
    const Vec2 along = touch_[j].normal, across = tangent_of(along);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t row = 2 * solved_[i];
      const Block g{by_x[row], by_y[row], by_x[row + 1], by_y[row + 1]};
      const Vec2 normal = touch_[i].normal, tangent = tangent_of(normal);
      const Vec2 pushed = contact::apply(g, along), pulled = contact::apply(g, across);
      w[2 * i] = dot(normal, pushed);
      w[2 * i + 1] = dot(tangent, pushed);
      w[2 * n + 2 * i] = dot(normal, pulled);
      w[2 * n + 2 * i + 1] = dot(tangent, pulled);
    }
  }
}

/// Places of all near nodes under the forces.
void RingWheel::place_all() {
  const std::size_t rows = 2 * near_.size();
  std::fill_n(moved_.begin(), rows, 0.0);
  for (std::size_t j = 0; j < solved_.size(); ++j) {
    if (law_[j].normal == 0.0 && law_[j].shear == 0.0) continue;
    const Vec2 normal = touch_[j].normal;
    const Vec2 force = law_[j].normal * normal + law_[j].shear * tangent_of(normal);
    const double* by_x = reply_.data() + rows * at(near_[solved_[j]].column);
    const double* by_y = by_x + rows;
    for (std::size_t i = 0; i < rows; ++i) moved_[i] += force.x * by_x[i] + force.y * by_y[i];
  }
  for (std::size_t i = 0; i < near_.size(); ++i)
    near_[i].place = near_[i].free + Vec2{moved_[2 * i], moved_[2 * i + 1]};
}

/// Nodes that were left out and are now in the ground become candidates. False: there are none.
bool RingWheel::join(const WheelMotion& m) {
  bool joined = false;
  for (Near& near : near_)
    if (!near.candidate && ground_.facet_near(m.center_next + near.place).gap < closed)
      joined = near.candidate = true;
  return joined;
}

/// Whether a candidate is now at another facet, or elsewhere on an arc.
bool RingWheel::turn_normals(const WheelMotion& m) const {
  bool turned = false;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const contact::Touch touch = ground_.facet_near(m.center_next + near_[solved_[i]].place);
    const Vec2 change = touch.normal - touch_[i].normal;
    turned |= dot(change, change) > 1e-20;
  }
  return turned;
}

void RingWheel::solve(const WheelMotion& m, WheelReport& report) {
  solved_.clear();
  law_.clear();
  if (!flat_) {  // the forces of before tell where nodes about are
    touch_.clear();
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const Vec2 force = near_[i].turn * memory_of(near_[i].node).force;
      if (force == Vec2{}) continue;
      find_reply(near_[i]);
      solved_.push_back(i);
      touch_.push_back({0.0, force});
      law_.push_back({});
      law_.back().normal = 1.0;
    }
    place_all();
  }
  for (int turn = 0; turn < most_turns; ++turn) {
    add_candidates(m);
    report.candidates = static_cast<int>(solved_.size());
    if (solved_.empty()) return;
    fill_law(m);
    solve_law(m, report);
    double free = 0.0;
    for (const GapContact& c : law_) {
      const Vec2 moved{c.free_slip, std::min(0.0, c.free_gap)};
      free = std::max(free, dot(moved, moved));
    }
    report.free = std::sqrt(free);
    place_all();
    if (join(m)) {
      turn = -1;  // as many nodes can join as there are
      continue;
    }
    if (flat_ || !turn_normals(m)) return;
  }
}

/// φ_cᴴ of what push_modes() and, of a ring of one sector, real_.push added since the last time.
void RingWheel::end_push() {
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    if (is_whole())
      s.force = real_.push.cast<Complexes>();
    else
      s.force.noalias() = harmonics_[h].contact.adjoint() * s.ground;
    s.ground.setZero();
  }
  if (is_whole()) real_.push.setZero();
}

/// Forces of the ground, and what they do to the modes and to the residual.
void RingWheel::take_forces(const WheelMotion& m, WheelReport& report) {
  const double lag = settings_.stiffness_damping / settings_.dt;
  for (const int node : active_) {
    Memory& memory = memory_of(node);
    memory.filtered_before = memory.filtered;
    memory.filtered = lag / (1.0 + lag) * memory.filtered;
  }
  contacts_.clear();
  forces_.clear();
  for (Near& near : near_) near.own = {};
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const GapContact& c = law_[i];
    if (c.normal == 0.0 && c.shear == 0.0) continue;
    Near& near = near_[solved_[i]];
    const Vec2 normal = touch_[i].normal;
    const Vec2 force = c.normal * normal + c.shear * tangent_of(normal);
    contacts_.push_back({near.node, normal, force, c.gap, c.slip, c.status});
    report.force += force;
    report.torque += cross(near.place, force);
    const Vec2 own = near.own = conj(near.turn) * force;
    push_modes(near.node, near.wave, own);
    if (is_whole()) real_.push += real_.on_modes(near.node, own);
    if (creep_) {
      forces_.push_back({near.node, own});
      continue;
    }
    Memory& memory = memory_of(near.node);
    if (memory.filtered == Vec2{} && memory.filtered_before == Vec2{})
      active_.insert(std::ranges::lower_bound(active_, near.node), near.node);
    memory.filtered += 1.0 / (1.0 + lag) * own;
  }
  end_push();
  if (creep_) creep_->step(forces_);
  for (Modes& s : modes_) {
    push_by(s, s.force, s.work);
    s.state += settings_.theta * s.work;
  }
  if (creep_) relax_modes();
  report.mean_force = settings_.theta * report.force;
  report.mean_torque = settings_.theta * report.torque;
  const Complex frame = rotation(m.angle);
  for (const Near& near : near_) {
    const Vec2 before = (1.0 - settings_.theta) *
                        (frame * ring_.stiffness.turn[at(sector(near.node))] * near.own_before);
    report.mean_force += before;
    report.mean_torque += cross(memory_of(near.node).place[0], before);
  }
  report.contacts = contacts_;
}

/// Places, gaps, statuses and forces at the end of the step, and what the modes do to contact
/// nodes.
void RingWheel::remember(const WheelMotion& m) {
  move_contact();
  if (sliding_) remember_sliding(m);
  std::erase_if(active_, [&](int node) {
    Memory& memory = memory_of(node);
    const bool gone = dot(memory.filtered, memory.filtered) < nothing * nothing;
    if (gone) memory.filtered = memory.filtered_before = {};
    return gone;
  });
  for (const int node : seen_) {
    Memory& memory = memory_of(node);
    memory.force = {};
    memory.side = 0.0;
    memory.status = Status::open;
    if (!std::ranges::binary_search(near_, node, {}, &Near::node)) memory.known = 0;
  }
  seen_.clear();
  for (const Near& near : near_) {
    Memory& memory = memory_of(near.node);
    memory.keep(near.place, ground_.facet_near(m.center_next + near.place).gap, near.own);
    seen_.push_back(near.node);
  }
  for (std::size_t l = 0; l < solved_.size(); ++l) {
    Memory& memory = memory_of(near_[solved_[l]].node);
    memory.status = law_[l].status;
    memory.side = law_[l].side;
  }
}

}  // namespace rondo::rom
