// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/implicit/implicit_elements.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

double product_of(const PlaneField& a, const PlaneField& b) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a.x[i] * b.x[i] + a.y[i] * b.y[i];
  return sum;
}

bool any_candidate(const Model& model, const NodeSet& nodes) {
  if (!model.contact) return false;
  std::vector<char> is_candidate(model.n_nodes(), 0);
  for (const int node : model.contact->nodes) is_candidate[at(node)] = 1;
  return std::ranges::any_of(nodes.node,
                             [&](int node) { return node >= 0 && is_candidate[at(node)]; });
}

}  // namespace

ImplicitElements::ImplicitElements(const Model& model, NodeSet nodes,
                                   std::unique_ptr<ImplicitOperator> implicit, double factored)
    : model_(model),
      nodes_(std::move(nodes)),
      implicit_(std::move(implicit)),
      factored_(factored),
      u_(nodes_.size()),
      before_(nodes_.size()),
      right_(nodes_.size()),
      change_(nodes_.size()),
      next_(nodes_.size()),
      free_(nodes_.size()),
      product_(nodes_.size()) {
  RONDO_DEMAND(implicit_ && nodes_.mass.size() == nodes_.size() &&
                   nodes_.turn.size() == nodes_.size() && model.dt > 0.0,
               nodes_.mass.size(), nodes_.turn.size(), nodes_.size(), model.dt);
  if (any_candidate(model, nodes_)) contact_.emplace(model_, nodes_);
}

/// M a (v - v⁻): what the explicit step divided by M a.
void ImplicitElements::find_right_side(double spin, const PlaneField& v) noexcept {
  const Complex a = velocity_update(model_.scheme, model_.dt, model_.mass_damping, spin).a;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double x = v.x[i] - before_.x[i], y = v.y[i] - before_.y[i], m = nodes_.mass[i];
    right_.x[i] = m * (a.re * x - a.im * y);
    right_.y[i] = m * (a.re * y + a.im * x);
  }
}

/// One solution with the factored A: what it lacks of the gyroscopic term acts on the change at
/// hand. @param off Δt (s - s of A). @return how far the change went, of its size
double ImplicitElements::iterate(double off, bool touching, const ContactStep* step) {
  for (std::size_t i = 0; i < next_.size(); ++i) {
    const double m = off * nodes_.mass[i];
    next_.x[i] = right_.x[i] + m * change_.y[i];
    next_.y[i] = right_.y[i] - m * change_.x[i];
  }
  if (touching) {
    free_ = next_;
    implicit_->solve(free_);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      free_.x[i] += before_.x[i];
      free_.y[i] += before_.y[i];
    }
    contact_->solve(*step, free_, next_);
  }
  implicit_->solve(next_);
  double moved = 0.0, size = 0.0;
  for (std::size_t i = 0; i < next_.size(); ++i) {
    moved =
        std::max({moved, std::abs(next_.x[i] - change_.x[i]), std::abs(next_.y[i] - change_.y[i])});
    size = std::max({size, std::abs(next_.x[i]), std::abs(next_.y[i])});
  }
  std::swap(change_, next_);
  return size > 0.0 ? moved / size : 0.0;
}

ImplicitEnergy ImplicitElements::energy() noexcept {
  const double dt = model_.dt;
  ImplicitEnergy e;
  implicit_->product(before_, product_);
  e.strain = 0.125 * dt * dt * product_of(before_, product_);
  if (model_.stiffness_damping == 0.0) return e;
  // v̄ᵀ K_I x = v⁻ᵀ K_I x + ½ xᵀ K_I x
  const double across = product_of(change_, product_);
  implicit_->product(change_, product_);
  e.dissipation_stiffness =
      0.5 * dt * model_.stiffness_damping * (across + 0.5 * product_of(change_, product_));
  return e;
}

ImplicitEnergy ImplicitElements::solve(double spin, const ContactStep* step, PlaneField& v,
                                       ContactReport& report) {
  RONDO_ASSERT(v.size() == nodes_.size() && u_.size() == v.size() && before_.size() == v.size(),
               v.size(), nodes_.size());
  find_right_side(spin, v);
  const bool touching = contact_ && step && contact_->find(*step, u_, before_, *implicit_);
  const double off = model_.dt * (spin - factored_);
  std::fill(change_.x.begin(), change_.x.end(), 0.0);
  std::fill(change_.y.begin(), change_.y.end(), 0.0);
  double moved = iterate(off, touching, step);
  // It falls by Δt |s - s of A| each time, down to round-off or the tolerance of the contacts.
  constexpr double round_off = 1e-16;
  for (double before = 4.0; off != 0.0 && moved > round_off && moved < 0.5 * before;) {
    before = moved;
    moved = iterate(off, touching, step);
  }
  for (std::size_t i = 0; i < v.size(); ++i) {
    v.x[i] = before_.x[i] + change_.x[i];
    v.y[i] = before_.y[i] + change_.y[i];
  }
  if (touching) contact_->report(*step, before_, v, report);
  return energy();
}

}  // namespace rondo::dynamics
