// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/massless/ring_contact.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/residual.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using contact::Block;

/// Gaps above this are closed to round-off [m].
constexpr double closed = -1e-14;
/// A second facet holds a node that stands still as near to it as this [m].
constexpr double corner_reach = 1e-9;

}  // namespace

bool near_second_facet(const contact::Ground& ground, Vec2 place, double way) noexcept {
  return ground.beside_concave_corner(place) <= std::max(way, corner_reach);
}

MasslessContact::MasslessContact(const Model& model)
    : model_(model),
      matrix_(model.stiffness, model.contact->nodes),
      lag_(model.stiffness_damping / model.dt),
      coupled_({.most_iterations = model.coupled.most_iterations}, model.coupled.dump_above) {
  RONDO_DEMAND(has_massless_contact(model) && !model.stiffness.row_start.empty());
  RONDO_DEMAND(matrix_.is_positive_definite());
  RONDO_DEMAND(model.dt > 0.0 && model.contact->tributary.size() == nodes().size(), model.dt,
               model.contact->tributary.size(), nodes().size());
  const std::size_t nc = nodes().size(), ni = neighbours().size();
  motion_ = {std::vector<Vec2>(nc + ni), std::vector<Vec2>(ni), std::vector<Vec2>(nc)};
  star_.resize(nc + ni);
  for (auto* field : {&load_, &usual_, &free_, &predicted_, &change_, &velocity_})
    field->resize(nc);
  joined_.resize(nc);
  for (RingContacts* at_time : {&now_, &next_}) at_time->contacts.reserve(nc);
}

/// - K_cc (u_c + Δu_c + β Δu_c/Δt) - K_ci (u_i + β v_i), Δu the way of the step before: by what the
/// ring goes another way, with contact.
void MasslessContact::load_ring() noexcept {
  const std::size_t nc = nodes().size();
  star_ = motion_.place;
  for (std::size_t i = 0; i < nc; ++i) {
    usual_[i] = step_->dt * motion_.before[i];
    star_[i] += (1.0 + lag_) * usual_[i];
  }
  for (std::size_t i = 0; i < motion_.rate.size(); ++i)
    star_[nc + i] += model_.stiffness_damping * motion_.rate[i];
  matrix_.product(star_, load_);
  for (Vec2& load : load_) load = -load;
}

/// (1 + b) K_cc (u_{n+2} - u_{n+1} - Δu_c) = load + Rᵀ Qᵀ λ.
void MasslessContact::move_ring(std::span<const RingContact> by, std::span<Vec2> change) noexcept {
  std::ranges::copy(load_, change.begin());
  const Complex back = conj(step_->rotation_next);
  for (const RingContact& c : by)
    change[at(c.node)] += back * from_frame(c.normal, c.impulse) / step_->dt;
  matrix_.solve(change);
  for (Vec2& d : change) d = d / (1.0 + lag_);
}

Vec2 MasslessContact::place_after(std::size_t i, Vec2 change) const noexcept {
  RONDO_ASSERT(step_ && i < nodes().size(), i, nodes().size());
  const Vec2 reference = model_.reference[at(nodes()[i])];
  return center_next_ + step_->rotation_next * (reference + motion_.place[i] + usual_[i] + change);
}

/// (gap, way along t)/Δt of a contact, `gap` being that at the predicted place.
Vec2 MasslessContact::law_velocity(const RingContact& c,
                                   std::span<const Vec2> change) const noexcept {
  const std::size_t i = at(c.node);
  const Vec2 arm = model_.reference[at(nodes()[i])] + motion_.place[i];
  const Vec2 from_predicted = step_->rotation_next * (change[i] - predicted_[i]);
  const Vec2 way =
      drive_of(*step_, arm) + step_->rotation_next * (usual_[i] + change[i]) / step_->dt;
  return {(c.gap + dot(c.normal, from_predicted)) / step_->dt, to_frame(c.normal, way).y};
}

/// A law is asked with the place and the slip that the node has now, and the impulse of before.
double MasslessContact::friction_of(const RingContact& c) const noexcept {
  const contact::Friction& friction = model_.contact->law.friction;
  if (friction.is_constant()) return friction.constant();
  const std::size_t i = at(c.node);
  const Vec2 arm = model_.reference[at(nodes()[i])] + motion_.place[i];
  const Vec2 w = to_frame(c.normal, velocity_before(*step_, arm, motion_.before[i]));
  return friction.coefficient({step_->center + step_->rotation * arm, std::abs(w.y),
                               c.impulse.x / (step_->dt * model_.contact->tributary[i])});
}

void MasslessContact::join(int node, const contact::Touch& touch) {
  joined_[at(node)] = 1;
  RingContact c;
  c.node = node;
  c.normal = touch.normal;
  c.gap = touch.gap;
  const auto before = std::ranges::lower_bound(now_.contacts, node, {},
                                               [](const RingContact& b) { return b.node; });
  if (before != now_.contacts.end() && before->node == node) c.impulse = before->impulse;
  c.friction = friction_of(c);
  next_.contacts.push_back(c);
}

/// Predicts the ring with the forces of t_{n+1}; nodes that touch there, or were pressed, join.
void MasslessContact::predict() {
  const contact::Ground& ground = model_.contact->ground;
  move_ring({}, free_);
  if (now_.contacts.empty())
    predicted_ = free_;
  else
    move_ring(now_.contacts, predicted_);
  std::fill(joined_.begin(), joined_.end(), char{0});
  next_.contacts.clear();
  for (const RingContact& c : now_.contacts) {
    if (c.impulse.x > 0.0) joined_[at(c.node)] = 1;
  }
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    const Vec2 place = place_after(i, predicted_[i]);
    if (joined_[i] == 0 && place.y > ground.top()) continue;
    const contact::Touches touches = ground.touches(place);
    if (touches.count > 0)
      join(static_cast<int>(i), touches.at[0]);
    else if (joined_[i] != 0)
      join(static_cast<int>(i), ground.facet_near(place));
  }
}

void MasslessContact::make_problem() {
  std::vector<RingContact>& contacts = next_.contacts;
  matrix_.release();
  columns_.clear();
  coupled_.clear();
  for (RingContact& c : contacts) {
    columns_.push_back(matrix_.inverse_column(c.node));
    c.free = law_velocity(c, free_);
    coupled_.add(c.free, 0.0, c.friction, c.impulse);
  }
  const double scale = 1.0 / (step_->dt * step_->dt * (1.0 + lag_));
  const auto to_frame_of = [&](const RingContact& c) {
    return conj(frame_of(c.normal)) * step_->rotation_next;
  };
  coupled_.couple_all([&](std::size_t j, std::size_t l) {
    contact::Block w = contact::in_frames(
        to_frame_of(contacts[j]), columns_[l][at(contacts[j].node)], to_frame_of(contacts[l]));
    for (double& entry : w) entry *= scale;
    return w;
  });
}

void MasslessContact::solve_law() {
  make_problem();
  const contact::CoupledResult& result = coupled_.solve();
  next_.iterations += result.iterations;
  next_.converged = next_.converged && result.converged;
  for (std::size_t j = 0; j < next_.contacts.size(); ++j) {
    next_.contacts[j].impulse = coupled_.impulse[j];
    next_.contacts[j].status = coupled_.status[j];
  }
}

/// Nodes that the solution has pushed into the ground join, once each; false: there are none.
bool MasslessContact::extend() {
  const contact::Ground& ground = model_.contact->ground;
  const std::size_t before = next_.contacts.size();
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    if (joined_[i] != 0) continue;
    const Vec2 place = place_after(i, change_[i]);
    if (place.y > ground.top()) continue;
    const contact::Touches touches = ground.touches(place);
    if (touches.count == 0 || touches.at[0].gap >= closed) continue;
    join(static_cast<int>(i), ground.facet_near(place_after(i, predicted_[i])));
  }
  if (next_.contacts.size() == before) return false;
  ++next_.extensions;
  return true;
}

/// Velocities, gaps and residuals of what was found.
void MasslessContact::finish() {
  for (std::size_t i = 0; i < velocity_.size(); ++i)
    velocity_[i] = motion_.before[i] + change_[i] / step_->dt;
  for (std::size_t j = 0; j < next_.contacts.size(); ++j) {
    RingContact& c = next_.contacts[j];
    const Vec2 w = law_velocity(c, change_);
    const double friction = coupled_.problem.friction[j], mass = coupled_.problem.mass[j];
    c.residual = contact::law_residual(c.impulse, w, 0.0, friction, mass) / mass;
    c.gap = w.x * step_->dt;
    if (c.impulse.x > 0.0 && !next_.two_facets)
      next_.two_facets =
          near_second_facet(model_.contact->ground, place_after(at(c.node), change_[at(c.node)]),
                            step_->dt * std::abs(w.y));
  }
  std::ranges::sort(next_.contacts, {}, [](const RingContact& c) { return c.node; });
}

void MasslessContact::solve(const ContactStep& step) {
  RONDO_ASSERT(motion_.place.size() == star_.size() && motion_.before.size() == nodes().size() &&
                   step.dt == model_.dt,
               motion_.place.size(), star_.size(), motion_.before.size(), step.dt);
  step_ = &step;
  center_next_ = step.center + step.dt * step.center_rate;
  std::swap(now_, next_);
  next_.iterations = next_.extensions = 0;
  next_.converged = true;
  next_.two_facets = false;
  load_ring();
  predict();
  do {
    if (!next_.contacts.empty()) solve_law();
    move_ring(next_.contacts, change_);
  } while (extend());
  finish();
  step_ = nullptr;
}

}  // namespace rondo::dynamics
