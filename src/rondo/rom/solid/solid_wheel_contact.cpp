// SPDX-License-Identifier: BSD-3-Clause
/// Contact of a step: nodes near the ground, the law, what its forces do.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using contact::SpaceTouch;
using Eigen::Index;

constexpr double near_share = 0.03;        ///< of the radius, above the ground: looked at
constexpr double candidate_share = 0.004;  ///< contact is solved
constexpr double nothing = 1e-9;           ///< filtered forces below it are 0              [N]
constexpr int most_turns = 3;              ///< of the normals, on ground that is not flat

}  // namespace

SpaceTouch SolidWheel::touch_of(const Near& near, const SolidMotion& m) const noexcept {
  return dynamics::nearest_in_space(ground_, m.center_next() + fixed(near, near.place, m));
}

/// Whether the undeformed nodes of a sector are near the ground.
bool SolidWheel::is_low(int j, const SolidMotion& m) const noexcept {
  const Complex turn = rotation(m.plane.angle_next) * ring_.stiffness.turn[at(j)];
  const double reach = model_.radius, ahead = m.plane.center_next.x;
  const double limit = dynamics::top_between(ground_, ahead - reach, ahead + reach) +
                       near_share * model_.radius - m.plane.center_next.y;
  for (const int row : ring_.contact)
    if (m.attitude_next.to_fixed(turn * ring_.place[at(row)]).y < limit) return true;
  return false;
}

/// The sectors that are near the ground, or whose nodes remember forces, and those between them.
void SolidWheel::find_window(const SolidMotion& m) {
  const int n = ring_.n_sectors();
  const double pitch = 2.0 * std::numbers::pi / n;
  const int below = wrapped(
      static_cast<int>(std::fmod(std::round(-m.plane.angle_next / pitch), static_cast<double>(n))));
  int low = 0, high = -1;
  for (int d = -n / 2; d < n - n / 2; ++d) {
    const int j = wrapped(below + d);
    bool taken = is_low(j, m);
    for (int c = 0; c < n_contact_ && !taken; ++c)
      taken = memory_of(j * n_contact_ + c).filtered != Vec3{};
    if (!taken) continue;
    if (high < low) low = d;
    high = d;
  }
  first_ = wrapped(below + low);
  n_window_ = high - low + 1;
}

/// Places of the nodes of the window without new forces.
void SolidWheel::find_near(const SolidMotion& m) {
  find_window(m);
  make_window();
  near_.clear();
  const Complex frame = rotation(m.plane.angle_next), waves = rotation(waves_at(m.plane));
  const double left = creep_ ? 1.0 : filter();
  for (int d = 0; d < n_window_; ++d) {
    const int j = wrapped(first_ + d);
    const Complex turn = frame * ring_.stiffness.turn[at(j)],
                  wave = waves * ring_.stiffness.turn[at(j)];
    if (creep_) creep_->write(creep_->left(), j, in_sector_);
    for (int c = 0; c < n_contact_; ++c) {
      Near& near = near_.emplace_back();
      near.node = j * n_contact_ + c;
      near.turn = turn;
      near.wave = wave;
      Memory& memory = memory_of(near.node);
      if (creep_) {
        const double* u = &in_sector_[at(3 * c)];
        memory.residual = {u[0], u[1], u[2]};
      } else if (memory.known == 0) {
        memory.residual = {};
        for (const int from : seen_)
          if (const Vec3 force = memory_of(from).filtered; force != Vec3{})
            memory.residual += product(near.node, from, force);
      }
      const Index row = Index{3} * ring_.contact[at(c)];
      const Vec3 spun{centrifugal_[row], centrifugal_[row + 1], centrifugal_[row + 2]};
      near.free = near.place = arm(near.node) + spun +
                               modal(near.node, near.wave, &Modes::contact) +
                               left * memory.residual;
    }
  }
  guess_forces(m);
}

/// Forces of the step before, which nearly stand still in space.
void SolidWheel::guess_forces(const SolidMotion& m) {
  const double pitch = 2.0 * std::numbers::pi / ring_.n_sectors();
  const double passed = (m.plane.angle_next - m.plane.angle) / pitch, whole = std::floor(passed);
  const double share = passed - whole;
  const int shift = static_cast<int>(whole) * n_contact_, n = static_cast<int>(memory_.size());
  const auto old = [&](int node) { return memory_of((node % n + n) % n).force; };
  for (Near& near : near_)
    near.force =
        (1.0 - share) * old(near.node + shift) + share * old(near.node + shift + n_contact_);
}

/// The distance that a node slides, fixed axes, were it at its place without new forces.
Vec3 SolidWheel::distance(const Near& near, const SolidMotion& m) const noexcept {
  const Memory& was = memory_of(near.node);
  const Vec3 way = m.center_next() - m.center(), free = fixed(near, near.free, m);
  if (was.known == 0) {  // it comes into sight: as if it only turned
    const Complex back = conj(rotation(m.plane.angle_next - m.plane.angle)) * near.turn;
    return way + free - m.attitude.to_fixed(back * near.free);
  }
  return was.slid(way, free, was.force != Vec3{}, bend_of(m.plane));
}

/// μ of a candidate where it was at the start of the step, by a distance that it slides in a step
/// and by the normal force [m], [N].
double SolidWheel::friction_at(std::size_t candidate, double slip, double force) const {
  const Near& near = near_[solved_[candidate]];
  contact::SlidingState state;
  state.place = place_before_[candidate];
  state.slip = slip / settings_.dt;
  const double area = area_[at(local(near.node))];
  if (area > 0.0) state.pressure = std::max(0.0, force) / area;
  return ground_.law.friction.coefficient(state);
}

/// μ by the slip and the pressure of the step before; a node that was open slides as it would
/// without a force.
double SolidWheel::friction_before(std::size_t candidate, const SolidMotion& m, Vec3 free) const {
  if (ground_.law.friction.is_constant()) return ground_.law.friction.constant();
  const Near& near = near_[solved_[candidate]];
  const Memory& was = memory_of(near.node);
  const Vec3 normal = touch_[candidate].frame.normal;
  return was.force != Vec3{}
             ? friction_at(candidate, was.slip, dot(normal, fixed(near, was.force, m)))
             : friction_at(candidate, std::hypot(free.y, free.z), 0.0);
}

/// Nodes that are low enough, or were pressed.
void SolidWheel::add_candidates(const SolidMotion& m) {
  solved_.clear();
  touch_.clear();
  place_before_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    Near& near = near_[i];
    const SpaceTouch touch = touch_of(near, m);
    near.candidate |= touch.gap < candidate_share * model_.radius || near.force != Vec3{};
    if (!std::isfinite(touch.gap)) {  // beside the road
      near.candidate = false;
      near.force = {};
    }
    if (!near.candidate) continue;
    solved_.push_back(i);
    touch_.push_back(touch);
    const Memory& was = memory_of(near.node);
    place_before_.push_back(was.known > 0 ? m.center() + was.place[0]
                                          : m.center_next() + fixed(near, near.place, m));
  }
}

/// The law of the candidates, with the facets that are nearest to their places.
void SolidWheel::fill_law(const SolidMotion& m) {
  cones_.resize(solved_.size());
  const auto first = static_cast<int>(solved_.front()) / n_contact_ * n_contact_;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    const contact::SpaceFrame& frame = touch_[i].frame;
    const Vec3 axes[] = {frame.normal, frame.tangent(), frame.line};
    ConeContact& c = cones_[i];
    c = {};
    c.place = static_cast<int>(solved_[i]) - first;
    const Vec3 slides = distance(near, m);
    c.free = {touch_[i].gap + dot(axes[0], fixed(near, near.free - near.place, m)),
              dot(axes[1], slides), dot(axes[2], slides)};
    for (std::size_t k = 0; k < 3; ++k)
      c.axes[k] = conj(near.turn) * m.attitude_next.from_fixed(axes[k]);
    if (on_moving_rim_)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto along = [&](Vec3 a) {
          return Vec3{dot(c.axes[0], a), dot(c.axes[1], a), dot(c.axes[2], a)};
        };
        c.lift[k] = along(near.moved[k]);
        c.reply[k] = along(near.reply[k]);
      }
    c.friction = friction_before(i, m, c.free);
    c.force = {dot(c.axes[0], near.force), dot(c.axes[1], near.force), dot(c.axes[2], near.force)};
  }
}

/// Places of all nodes of the window under the forces of the candidates.
void SolidWheel::place_all() {
  const Index rows = Index{3} * static_cast<Index>(near_.size());
  moved_.assign(at(rows), 0.0);
  for (Near& near : near_) near.place = near.free;
  if (solved_.empty()) return;
  const Index begin = Index{3} * (static_cast<Index>(solved_.front()) / n_contact_ * n_contact_);
  const std::span<const double> known = law_.moved();
  const Index end = begin + static_cast<Index>(known.size());
  std::ranges::copy(known, moved_.begin() + begin);
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Vec3 r = near_[solved_[i]].force;
    if (r == Vec3{}) continue;
    const Index j = Index{3} * static_cast<Index>(solved_[i]);
    const double *a = window_.column(j), *b = window_.column(j + 1), *c = window_.column(j + 2);
    const auto add = [&](Index from, Index to) {
      double* __restrict out = moved_.data();
      for (Index k = from; k < to; ++k) out[k] += r.x * a[k] + r.y * b[k] + r.z * c[k];
    };
    add(0, begin);
    add(end, rows);
  }
  for (std::size_t i = 0; i < near_.size(); ++i)
    near_[i].place = near_[i].free + Vec3{moved_[3 * i], moved_[3 * i + 1], moved_[3 * i + 2]};
  if (!on_moving_rim_) return;
  std::array<double, 3> rates{};
  for (const std::size_t i : solved_)
    for (std::size_t k = 0; k < 3; ++k) rates[k] += dot(near_[i].reply[k], near_[i].force);
  for (Near& near : near_)
    for (std::size_t k = 0; k < 3; ++k) near.place += rates[k] * near.moved[k];
}

/// Nodes that were left out and are now in the ground become candidates. False: there are none.
bool SolidWheel::join(const SolidMotion& m) {
  const double closed = -1e-6 * law_residual_ * model_.radius;
  bool joined = false;
  for (Near& near : near_)
    if (!near.candidate && touch_of(near, m).gap < closed) joined = near.candidate = true;
  return joined;
}

/// Whether a candidate is now at another facet, or elsewhere on an arc.
bool SolidWheel::turn_normals(const SolidMotion& m) const {
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Vec3 change = touch_of(near_[solved_[i]], m).frame.normal - touch_[i].frame.normal;
    if (dot(change, change) > 1e-20) return true;
  }
  return false;
}

/// Forces of the candidates, and the places that they make. Where no coefficients of slip and
/// pressure of the step itself are found, those of the step before are taken.
void SolidWheel::solve_law(SolidWheelReport& report) {
  const Index sectors = static_cast<Index>(solved_.back()) / n_contact_ -
                        static_cast<Index>(solved_.front()) / n_contact_ + 1;
  const bool follows = !ground_.law.friction.is_constant();
  if (follows) before_ = cones_;
  const Index rows = sectors * ring_.n_contact();
  ConeLaw::Report solved = law_.solve(cones_, window_, rows, follows ? &friction_ : nullptr);
  report.late = follows && !(solved.residual <= law_residual_);
  if (report.late) {
    cones_ = before_;
    report.iterations += solved.sweeps;
    solved = law_.solve(cones_, window_, rows);
  }
  report.iterations += solved.sweeps;
  report.second_method |= solved.by_newton;
  report.law_residual = solved.residual;
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const ConeContact& c = cones_[i];
    near_[solved_[i]].force = c.force.x * c.axes[0] + c.force.y * c.axes[1] + c.force.z * c.axes[2];
  }
  place_all();
}

void SolidWheel::solve(const SolidMotion& m, SolidWheelReport& report) {
  solved_.clear();
  cones_.clear();
  if (!flat_) {  // the forces of before tell where nodes about are
    for (std::size_t i = 0; i < near_.size(); ++i)
      if (near_[i].force != Vec3{}) solved_.push_back(i);
    law_.clear();
    place_all();
  }
  for (int turn = 0; turn < most_turns; ++turn) {
    add_candidates(m);
    report.candidates = static_cast<int>(solved_.size());
    if (solved_.empty()) {
      law_.clear();
      place_all();
      return;
    }
    fill_law(m);
    solve_law(report);
    double free = 0.0;
    for (std::size_t i = 0; i < solved_.size(); ++i) {
      const ConeContact& c = cones_[i];
      const Vec3 moved{std::min(0.0, c.free.x), c.free.y, c.free.z};
      free = std::max(free, dot(moved, moved));
    }
    report.free = std::sqrt(free);
    if (join(m)) {
      turn = -1;  // as many nodes can join as there are
      continue;
    }
    if (flat_ || !turn_normals(m)) return;
  }
}

/// Forces of the ground, and what they do to the modes.
void SolidWheel::take_forces(const SolidMotion& m, SolidWheelReport& report) {
  contacts_.clear();
  for (Modes& s : modes_) s.ground.setZero();
  std::size_t next = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    Near& near = near_[i];
    const bool solved = next < solved_.size() && solved_[next] == i;
    const std::size_t l = next;
    next += solved ? 1 : 0;
    if (!solved || near.force == Vec3{}) {
      near.force = {};
      continue;
    }
    const Vec3 force = fixed(near, near.force, m);
    const ConeContact& c = cones_[l];
    contacts_.push_back({near.node, touch_[l].frame, force, c.moved, c.friction, c.status});
    report.end.force += force;
    report.end.moment += cross(fixed(near, near.place, m), force);
    report.torque += cross(near.place, near.force).z;
    push_modes(near.node, near.wave, near.force);
  }
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const Index r = s.force.size();
    s.force.noalias() = harmonics_[h].contact.adjoint() * s.ground;
    push_by(s, s.force, s.work);
    s.work *= settings_.theta;
    s.state += s.work;
    s.answered.noalias() = harmonics_[h].contact * s.work.head(r);
  }
  if (creep_)
    creep_under_forces();
  else
    filter_forces();
  report.mean.force = settings_.theta * report.end.force + (1.0 - settings_.theta) * last_.force;
  report.mean.moment = settings_.theta * report.end.moment + (1.0 - settings_.theta) * last_.moment;
  report.mean_torque = m.attitude_next.from_fixed(report.mean.moment).z;
  last_ = report.end;
  report.contacts = contacts_;
}

/// The forces that the residual answers to, and its answer: implicit Euler.
void SolidWheel::filter_forces() {
  const double left = filter();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const Near& near = near_[i];
    Memory& memory = memory_of(near.node);
    memory.filtered_before = memory.filtered;
    memory.residual_before = memory.residual;
    memory.filtered = left * memory.filtered + (1.0 - left) * near.force;
    const Vec3 moved{moved_[3 * i], moved_[3 * i + 1], moved_[3 * i + 2]};
    memory.residual =
        left * memory.residual + moved - modal(near.node, near.wave, &Modes::answered);
  }
}

/// What viscous materials remember of the forces.
void SolidWheel::creep_under_forces() {
  creep_->clear_forces();
  for (const Near& near : near_)
    if (near.force != Vec3{})
      creep_->add_force(sector(near.node), Index{3} * local(near.node), near.force);
  creep_->step();
  creep_->use(shares_);
  relax_modes();
}

/// Places, gaps and forces at the end of the step, and what the modes do to contact nodes.
void SolidWheel::remember(const SolidMotion& m) {
  move_contact();
  for (const int node : seen_) {
    const int d = wrapped(sector(node) - first_);
    if (d >= n_window_) memory_of(node) = {};
  }
  seen_.clear();
  for (const Near& near : near_) {
    Memory& memory = memory_of(near.node);
    memory.keep(fixed(near, near.place, m), touch_of(near, m).gap, near.force);
    memory.slip = 0.0;
    if (dot(memory.filtered, memory.filtered) < nothing * nothing) memory.filtered = {};
    seen_.push_back(near.node);
  }
  for (std::size_t l = 0; l < solved_.size(); ++l)
    memory_of(near_[solved_[l]].node).slip = std::hypot(cones_[l].moved.y, cones_[l].moved.z);
}

}  // namespace rondo::rom
