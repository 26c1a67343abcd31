// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/contact_phase.hpp"

#include <algorithm>

#include "rondo/contact/pair.hpp"
#include "rondo/contact/residual.hpp"

namespace rondo::dynamics {
namespace {

using contact::Status;

/// Kinematics of one node at t_{n+1} in the fixed frame, from the exact discrete increments (4.2).
struct NodeMotion {
  Vec2 drive;  ///< velocity of the step to come without v⁺: (e^{iΔθ} - 1) R (X+u)/Δt + Δc/Δt
  Vec2 before;  ///< (x_{n+1} - x_n)/Δt
};

NodeMotion node_motion(const Model& model, const State& state, std::size_t node) noexcept {
  const FrameStep& f = state.frame;
  const Vec2 arm = model.reference[node] + state.u[node];
  const Vec2 back = rotation_minus_one(-f.turn_before);
  NodeMotion m;
  m.drive = (f.rotation * (rotation_minus_one(f.turn) * arm) + f.advance) / model.dt;
  m.before = f.rotation * (state.v[node] + back * state.v[node] - back * arm / model.dt) +
             f.advance_before / model.dt;
  return m;
}

void find_active(const Model& model, State& state) noexcept {
  state.active.clear();
  const ContactModel& contact = *model.contact;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(contact.nodes[k]);
    const contact::Touches touches = contact.ground.touches(position(model, state, node));
    for (int i = 0; i < touches.count; ++i) {
      const contact::Touch& touch = touches.at[static_cast<std::size_t>(i)];
      ActiveContact active;
      active.candidate = k;
      active.normal = touch.normal;
      active.gap = touch.gap;
      state.active.push_back(active);
    }
  }
}

/// Everything the local solve of one node needs; contacts is 1 or 2 entries of state.active.
struct NodeContact {
  std::span<ActiveContact> contacts;
  std::size_t node;
  NodeMotion motion;
  Vec2 turn_next;  ///< R(θ_{n+2})
  Vec2 delassus;   ///< e^{iΔθ}/(m a)
};

void set_velocities(const Model& model, const State& state, NodeContact& c) noexcept {
  for (ActiveContact& a : c.contacts) {
    a.before = conj(a.normal) * c.motion.before;
    a.free = conj(a.normal) * (c.motion.drive + c.turn_next * state.v_next[c.node]);
    a.bounce = model.contact->law.restitution * std::min(a.before.x, 0.0);
  }
}

void solve(const Model& model, NodeContact& c, ContactReport& report) noexcept {
  const double friction = model.contact->law.friction;
  if (c.contacts.size() == 1) {
    ActiveContact& a = c.contacts[0];
    const auto solution = contact::solve_local({a.free, c.delassus, a.bounce}, friction);
    a.impulse = solution.impulse;
    a.status = solution.status;
    return;
  }
  ActiveContact &a = c.contacts[0], &b = c.contacts[1];
  const auto solution = contact::solve_pair(
      {{a.free, b.free}, {a.bounce, b.bounce}, c.delassus, conj(a.normal) * b.normal}, friction);
  for (std::size_t i = 0; i < 2; ++i) {
    c.contacts[i].impulse = solution.contact[i].impulse;
    c.contacts[i].status = solution.contact[i].status;
  }
  ++report.pairs;
  report.pairs_not_converged += solution.converged ? 0 : 1;
}

/// v⁺ = v_free + Σ Rᵀ n r/(m a); a node that sticks gets the velocity that w = (-bounce, 0) means,
/// so that sticking is exact (4.6).
void correct_velocity(const Model& model, State& state, const NodeContact& c, Vec2 a) noexcept {
  Vec2 impulse;
  for (const ActiveContact& contact : c.contacts) {
    if (contact.status == Status::stick) {
      state.v_next[c.node] =
          conj(c.turn_next) * (contact.normal * Vec2{-contact.bounce, 0.0} - c.motion.drive);
      return;
    }
    impulse += contact.normal * contact.impulse;
  }
  if (impulse == Vec2{}) return;
  state.v_next[c.node] += conj(state.frame.rotation) * impulse / (model.mass[c.node] * a);
}

void report_node(const Model& model, const State& state, const NodeContact& c,
                 ContactReport& report) noexcept {
  bool pressed = false, sticks = true;
  for (ActiveContact& a : c.contacts) {
    a.after = conj(a.normal) * (c.motion.drive + c.turn_next * state.v_next[c.node]);
    const double mass = model.mass[c.node];
    const double residual =
        contact::law_residual(a.impulse, a.after, a.bounce, model.contact->law.friction, mass);
    if (!(residual / mass <= report.residual)) report.residual = residual / mass;  // NaN too
    report.penetration = std::max(report.penetration, -a.gap);
    report.free_velocity = std::max(report.free_velocity, norm(a.free));
    const Vec2 impulse = a.normal * a.impulse;
    const Vec2 arm = state.frame.rotation * (model.reference[c.node] + state.u[c.node]);
    report.impulse += impulse;
    report.angular_impulse += cross(arm, impulse);
    if (a.impulse.x <= 0.0) continue;
    pressed = true;
    sticks = sticks && a.status == Status::stick;
  }
  if (!pressed) return;
  ++report.nodes;
  report.sticking += sticks ? 1 : 0;
  report.length += model.contact->tributary[c.contacts[0].candidate];
}

}  // namespace

ContactReport contact_phase(const Model& model, State& state,
                            const VelocityUpdate& update) noexcept {
  ContactReport report;
  find_active(model, state);
  const FrameStep& f = state.frame;
  const Vec2 turn = rotation(f.turn);
  for (std::size_t i = 0; i < state.active.size();) {
    const std::size_t k = state.active[i].candidate;
    const bool pair = i + 1 < state.active.size() && state.active[i + 1].candidate == k;
    NodeContact c;
    c.contacts = std::span(state.active).subspan(i, pair ? 2 : 1);
    c.node = static_cast<std::size_t>(model.contact->nodes[k]);
    c.motion = node_motion(model, state, c.node);
    c.turn_next = f.rotation * turn;
    c.delassus = turn / (model.mass[c.node] * update.a);
    set_velocities(model, state, c);
    solve(model, c, report);
    correct_velocity(model, state, c, update.a);
    report_node(model, state, c, report);
    i += c.contacts.size();
  }
  return report;
}

}  // namespace rondo::dynamics
