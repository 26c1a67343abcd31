// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/solid/solid_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/contact/cone_pair.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::dynamics {
namespace {

using contact::Status;

/// Largest number of passes over the two facets of a node.
constexpr int most_passes = 1000;

/// The frame of a contact in the axes of the wheel.
struct Frame {
  Vec3 normal, tangent, line;

  Frame(const GroundFrame& ground, const contact::SpaceFrame& frame) noexcept
      : normal(ground.to_wheel(frame.normal)),
        tangent(ground.to_wheel(frame.tangent())),
        line(ground.to_wheel(frame.line)) {}

  [[nodiscard]] Vec3 to(Vec3 a) const noexcept {
    return {dot(normal, a), dot(tangent, a), dot(line, a)};
  }
  [[nodiscard]] Vec3 from(Vec3 a) const noexcept {
    return a.x * normal + a.y * tangent + a.z * line;
  }
};

using Mobility = SolidMobility;

/// Rows of Q_a W Q_bᵀ.
std::array<Vec3, 3> delassus(const Mobility& w, const Frame& a, const Frame& b) noexcept {
  const Vec3 columns[3] = {a.to(w * b.normal), a.to(w * b.tangent), a.to(w * b.line)};
  return {Vec3{columns[0].x, columns[1].x, columns[2].x},
          Vec3{columns[0].y, columns[1].y, columns[2].y},
          Vec3{columns[0].z, columns[1].z, columns[2].z}};
}

/// @return whether the solution of the law converged
bool solve_one(const Mobility& w, const Frame& frame, Vec3 free, ActiveContact& c) noexcept {
  const auto solution =
      contact::solve_spatial({free, delassus(w, frame, frame), c.bounce}, c.friction);
  c.impulse = solution.impulse;
  c.status = solution.status;
  return solution.converged;
}

/// Solves one facet after the other until neither changes. @return whether that was reached
bool solve_in_turn(const Mobility& w, std::span<const Frame> frames,
                   std::span<ActiveContact> contacts) noexcept {
  bool still = false;
  for (int pass = 0; pass < most_passes && !still; ++pass) {
    still = true;
    for (std::size_t i = 0; i < 2; ++i) {
      ActiveContact& c = contacts[i];
      const Vec3 before = c.impulse;
      const Vec3 push = w * frames[1 - i].from(contacts[1 - i].impulse);
      const Vec3 free = c.free + frames[i].to(push);
      still = solve_one(w, frames[i], free, c) && still;
      still = norm(c.impulse - before) <= 1e-15 * norm(before) && still;
    }
  }
  return still;
}

/// Turns the frame of the second contact into that of the first, about the line that they share.
Complex turn_between(const contact::SpaceFrame& a, const contact::SpaceFrame& b) noexcept {
  return {dot(a.normal, b.normal), dot(a.line, cross(a.normal, b.normal))};
}

/// @pre both have one μ and one line. @return whether a case was accepted
bool solve_by_cases(const Mobility& w, std::span<const Frame> frames,
                    std::span<ActiveContact> contacts) noexcept {
  const ActiveContact &a = contacts[0], &b = contacts[1];
  const auto pair = contact::solve_spatial_pair({a.free,
                                                 delassus(w, frames[0], frames[0]),
                                                 {a.bounce, b.bounce},
                                                 turn_between(a.space, b.space)},
                                                a.friction);
  for (std::size_t i = 0; i < 2 && pair.converged; ++i) {
    contacts[i].impulse = pair.contact[i].impulse;
    contacts[i].status = pair.contact[i].status;
  }
  return pair.converged;
}

/// Solves by cases, which takes one μ for both; if that is not so or none is accepted, in turn.
void solve_two(const Mobility& w, std::span<const Frame> frames, std::span<ActiveContact> contacts,
               ContactReport& report) noexcept {
  ++report.pairs;
  const bool one_friction = contacts[0].friction == contacts[1].friction;
  if (one_friction && solve_by_cases(w, frames, contacts)) return;
  if (!solve_in_turn(w, frames, contacts)) ++report.pairs_not_converged;
}

double friction_of(const SolidContactStep& s, const SolidContactNode& node, const ActiveContact& c,
                   std::size_t i) noexcept {
  const contact::Friction& friction = s.plane.law->friction;
  if (friction.is_constant()) return friction.constant();
  return friction.coefficient(
      {place_in_space(s, node.arm), std::hypot(c.before.y, c.before.z), node.pressure[i]});
}

/// v⁺, co-rotating frame; sticking is exact.
Vec3 corrected_velocity(const SolidContactStep& s, const SolidContactNode& node, Vec3 drive,
                        std::span<const Frame> frames,
                        std::span<const ActiveContact> contacts) noexcept {
  Vec3 impulse;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].status == Status::stick) {
      const Vec3 rest = frames[i].from({-contacts[i].bounce, 0.0, 0.0}) - drive;
      return {conj(s.plane.rotation_next) * rest.plane(), rest.z};
    }
    impulse += frames[i].from(contacts[i].impulse);
  }
  if (impulse == Vec3{}) return node.free;
  return node.free + velocity_change(s, node.mass, impulse);
}

void add_works(const SolidContactStep& s, const SolidContactNode& node, Vec3 after, Vec3 push,
               const ActiveContact& c, ContactReport& report) noexcept {
  const Vec3 impulse{conj(s.plane.rotation) * push.plane(), push.z};  // co-rotating frame
  const double work = dot(impulse, 0.5 * (node.before + after));
  const Vec3 mean = 0.5 * (c.before + c.after), r = c.impulse;
  report.work += work;
  report.dissipation_friction -= r.y * mean.y + r.z * mean.z;
  report.loss_impact -= r.x * mean.x;
  report.work_rim += work - dot(r, mean);
}

void report_contacts(const SolidContactStep& s, const SolidContactNode& node, Vec3 after,
                     std::span<const Frame> frames, std::span<ActiveContact> contacts,
                     ContactReport& report) noexcept {
  const Vec3 arm = s.plane.rotation * node.arm;
  const Vec3 w = drive_of(s, node.arm) + s.plane.rotation_next * after;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ActiveContact& c = contacts[i];
    c.after = frames[i].to(w);
    const Vec3 push = frames[i].from(c.impulse);
    add_works(s, node, after, push, c, report);
    add_impulse(s, arm, push, report);
    const double residual =
        contact::law_residual(c.impulse, c.after, c.bounce, c.friction, node.mass);
    report.residual = keep_larger(report.residual, residual / node.mass);
    report.penetration = std::max(report.penetration, -c.gap);
    report.free_velocity = std::max(report.free_velocity, norm(c.free));
  }
  report.count(contacts, node.tributary);
}

}  // namespace

SolidContactStep::SolidContactStep(const Model& model, const FrameStep& f,
                                   const VelocityUpdate& update, double axial) noexcept
    : plane(model, f, update),
      ground(model.motion.camber),
      lateral(f.center.z),
      axial_a(axial),
      center_rate(ground.to_wheel(f.advance) / model.dt),
      center_rate_before(ground.to_wheel(f.advance_before) / model.dt) {}

SolidContactStep::SolidContactStep(const Model& model, const FrameStep& f) noexcept
    : plane(model, f), ground(model.motion.camber), lateral(f.center.z), axial_a(1.0) {}

Vec3 drive_of(const SolidContactStep& s, Vec3 arm) noexcept {
  const Vec2 turning = s.plane.rotation * (s.plane.turn_minus_one * arm.plane()) / s.plane.dt;
  return Vec3(turning, 0.0) + s.center_rate;
}

Vec3 velocity_before(const SolidContactStep& s, Vec3 arm, Vec3 before) noexcept {
  const Vec2 v = before.plane();
  const Vec2 turning =
      s.plane.rotation * (v + s.plane.turn_back * v - s.plane.turn_back * arm.plane() / s.plane.dt);
  return Vec3(turning, before.z) + s.center_rate_before;
}

Vec3 velocity_change(const SolidContactStep& s, double mass, Vec3 impulse) noexcept {
  const Vec2 plane = conj(s.plane.rotation) * impulse.plane() / (mass * s.plane.a);
  return {plane, impulse.z / (mass * s.axial_a)};
}

void add_impulse(const SolidContactStep& s, Vec3 arm, Vec3 push, ContactReport& report) noexcept {
  const Vec3 normal = s.ground.to_wheel({0.0, 1.0, 0.0});
  const Vec3 moment = cross(arm, push);
  report.impulse += s.ground.from_wheel(push);
  report.angular_impulse += moment.z;
  report.moment_aligning += dot(normal, moment);
  report.moment_overturning += moment.x + s.plane.center.y * cross(normal, push).x;
}

Vec3 solve_contacts(const SolidContactStep& s, const SolidContactNode& node,
                    const contact::SpaceTouches& touches, std::span<ActiveContact> contacts,
                    ContactReport& report) noexcept {
  const Vec3 drive = drive_of(s, node.arm);
  const Vec3 before = velocity_before(s, node.arm, node.before);
  const Vec3 free = drive + s.plane.rotation_next * node.free;
  const std::array frames{Frame(s.ground, touches.at[0].frame),
                          Frame(s.ground, touches.at[1].frame)};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ActiveContact& c = contacts[i] = {};
    c.candidate = node.candidate;
    c.space = touches.at[i].frame;
    c.gap = touches.at[i].gap;
    c.before = frames[i].to(before);
    c.free = frames[i].to(free);
    c.bounce = contact::restitution_shift(*s.plane.law, c.before.x, c.before.x);
    c.friction = friction_of(s, node, c, i);
  }
  const Mobility w(s, node.mass);
  if (contacts.size() == 2)
    solve_two(w, frames, contacts, report);
  else
    (void)solve_one(w, frames[0], contacts[0].free, contacts[0]);
  const Vec3 after = corrected_velocity(s, node, drive, frames, contacts);
  report_contacts(s, node, after, frames, contacts, report);
  return after;
}

}  // namespace rondo::dynamics
