// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/contact_node.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/pair.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::dynamics {
namespace {

using contact::Status;

const contact::Law no_law;

void solve(Complex delassus, std::span<ActiveContact> contacts, ContactReport& report) noexcept {
  if (contacts.size() == 1) {
    ActiveContact& a = contacts[0];
    const auto solution = contact::solve_local({a.free.plane(), delassus, a.bounce}, a.friction);
    a.impulse = solution.impulse;
    a.status = solution.status;
    return;
  }
  ActiveContact &a = contacts[0], &b = contacts[1];
  const auto solution = contact::solve_pair({{a.free.plane(), b.free.plane()},
                                             {a.bounce, b.bounce},
                                             delassus,
                                             rotation_between(a.normal, b.normal),
                                             {a.friction, b.friction}});
  for (std::size_t i = 0; i < 2; ++i) {
    contacts[i].impulse = solution.contact[i].impulse;
    contacts[i].status = solution.contact[i].status;
  }
  ++report.pairs;
  report.pairs_not_converged += solution.converged ? 0 : 1;
}

/// v⁺ = v_free + Σ Rᵀ n r/(m a); a sticking node gets the velocity that follows from w = (-bounce,
/// 0), so that sticking is exact (4.6).
Vec2 corrected_velocity(const ContactStep& s, const ContactNode& node, Vec2 drive,
                        std::span<const ActiveContact> contacts) noexcept {
  Vec2 impulse;
  for (const ActiveContact& c : contacts) {
    if (c.status == Status::stick)
      return conj(s.rotation_next) * (from_frame(c.normal, {-c.bounce, 0.0}) - drive);
    impulse += from_frame(c.normal, c.impulse.plane());
  }
  if (impulse == Vec2{}) return node.free;
  return node.free + conj(s.rotation) * impulse / (node.mass * s.a);
}

void add_works(const ContactStep& s, const ContactNode& node, Vec2 after, const ActiveContact& c,
               ContactReport& report) noexcept {
  const Vec2 impulse = conj(s.rotation) * from_frame(c.normal, c.impulse.plane());  // as v
  const double work = dot(impulse, 0.5 * (node.before + after));
  const Vec3 mean = 0.5 * (c.before + c.after);
  report.work += work;
  report.dissipation_friction -= c.impulse.y * mean.y;
  report.loss_impact -= c.impulse.x * mean.x;
  report.work_rim += work - dot(c.impulse, mean);
}

void report_node(const ContactStep& s, const ContactNode& node,
                 std::span<const ActiveContact> contacts, ContactReport& report) noexcept {
  const Vec2 arm = s.rotation * node.arm;
  for (const ActiveContact& c : contacts) {
    const double residual =
        contact::law_residual(c.impulse.plane(), c.after.plane(), c.bounce, c.friction, node.mass);
    report.residual = keep_larger(report.residual, residual / node.mass);
    report.penetration = std::max(report.penetration, -c.gap);
    report.free_velocity = std::max(report.free_velocity, norm(c.free.plane()));
    const Vec2 impulse = from_frame(c.normal, c.impulse.plane());
    report.impulse += impulse;
    report.angular_impulse += cross(arm, impulse);
  }
  report.count(contacts, node.tributary);
}

}  // namespace

void ContactReport::count(std::span<const ActiveContact> contacts, double tributary) noexcept {
  bool pressed = false, sticks = true;
  for (const ActiveContact& c : contacts) {
    if (c.impulse.x <= 0.0) continue;
    pressed = true;
    sticks = sticks && c.status == Status::stick;
  }
  if (!pressed) return;
  ++nodes;
  sticking += sticks ? 1 : 0;
  length += tributary;
}

void sort_by_candidate(std::vector<ActiveContact>& active) noexcept {
  for (auto at = active.begin(); at != active.end(); ++at)
    std::rotate(
        std::upper_bound(active.begin(), at, at->candidate,
                         [](std::size_t k, const ActiveContact& c) { return k < c.candidate; }),
        at, at + 1);
}

void ContactReport::add(const ContactReport& other) noexcept {
  impulse += other.impulse;
  angular_impulse += other.angular_impulse;
  moment_aligning += other.moment_aligning;
  moment_overturning += other.moment_overturning;
  nodes += other.nodes;
  sticking += other.sticking;
  pairs += other.pairs;
  pairs_not_converged += other.pairs_not_converged;
  clusters += other.clusters;
  clusters_not_converged += other.clusters_not_converged;
  cluster_largest = std::max(cluster_largest, other.cluster_largest);
  cluster_iterations = std::max(cluster_iterations, other.cluster_iterations);
  extensions = std::max(extensions, other.extensions);
  two_facets = two_facets || other.two_facets;
  between_bodies += other.between_bodies;
  length += other.length;
  penetration = std::max(penetration, other.penetration);
  free_velocity = std::max(free_velocity, other.free_velocity);
  residual = keep_larger(residual, other.residual);
  work += other.work;
  dissipation_friction += other.dissipation_friction;
  loss_impact += other.loss_impact;
  work_rim += other.work_rim;
  if (other.late <= late) return;
  late = other.late;
  late_at = other.late_at;
}

ContactStep::ContactStep(const Model& model, const FrameStep& f,
                         const VelocityUpdate& update) noexcept
    : rotation(f.rotation),
      rotation_next(f.rotation * rondo::rotation(f.turn)),
      turn(rondo::rotation(f.turn)),
      turn_minus_one(rotation_minus_one(f.turn)),
      turn_back(rotation_minus_one(-f.turn_before)),
      center(f.center.plane()),
      center_rate(f.advance.plane() / model.dt),
      center_rate_before(f.advance_before.plane() / model.dt),
      a(update.a),
      dt(model.dt),
      law(model.contact ? &model.contact->law : &no_law) {}

namespace {

FrameStep at_rest(const FrameStep& frame) noexcept {
  FrameStep f;
  f.rotation = frame.rotation;
  f.center = frame.center;
  return f;
}

}  // namespace

ContactStep::ContactStep(const Model& model, const FrameStep& frame) noexcept
    : ContactStep(model, at_rest(frame), {{1.0, 0.0}, {0.0, 0.0}}) {}

Vec2 drive_of(const ContactStep& s, Vec2 arm) noexcept {
  return s.rotation * (s.turn_minus_one * arm) / s.dt + s.center_rate;
}

Vec2 velocity_before(const ContactStep& s, Vec2 arm, Vec2 before) noexcept {
  return s.rotation * (before + s.turn_back * before - s.turn_back * arm / s.dt) +
         s.center_rate_before;
}

Vec2 solve_contacts(const ContactStep& s, const ContactNode& node, const contact::Touches& touches,
                    std::span<ActiveContact> contacts, ContactReport& report) noexcept {
  const Vec2 drive = drive_of(s, node.arm);
  const Vec2 before = velocity_before(s, node.arm, node.before);
  const Vec2 place = s.center + s.rotation * node.arm;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ActiveContact& c = contacts[i];
    c.candidate = node.candidate;
    c.normal = touches.at[i].normal;
    c.gap = touches.at[i].gap;
    c.before = to_frame(c.normal, before);
    c.free = to_frame(c.normal, drive + s.rotation_next * node.free);
    c.bounce = contact::restitution_shift(*s.law, c.before.x, c.before.x);
    c.friction = s.law->friction.coefficient({place, std::abs(c.before.y), node.pressure[i]});
  }
  solve(s.turn / (node.mass * s.a), contacts, report);
  const Vec2 after = corrected_velocity(s, node, drive, contacts);
  report_contacts(s, node, after, contacts, report);
  return after;
}

void report_contacts(const ContactStep& s, const ContactNode& node, Vec2 after,
                     std::span<ActiveContact> contacts, ContactReport& report) noexcept {
  const Vec2 drive = drive_of(s, node.arm);
  for (ActiveContact& c : contacts) {
    c.after = to_frame(c.normal, drive + s.rotation_next * after);
    add_works(s, node, after, c, report);
  }
  report_node(s, node, contacts, report);
}

}  // namespace rondo::dynamics
