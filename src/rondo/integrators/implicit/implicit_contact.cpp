// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/implicit/implicit_contact.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/friction_work.hpp"

namespace rondo::dynamics {
namespace {

using contact::Block;

double largest_of(const Block& a) noexcept {
  double largest = 0.0;
  for (const double value : a) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

ImplicitContact::ImplicitContact(const Model& model, const NodeSet& nodes)
    : model_(model),
      nodes_(nodes),
      is_held_(model.contact->nodes.size()),
      unit_(nodes.size()),
      coupled_({.most_iterations = model.coupled.most_iterations}, model.coupled.dump_above) {
  RONDO_DEMAND(
      nodes.turn.size() == nodes.size() &&
          (nodes.sectors == 0 || (nodes.row_size > 0 && nodes.size() % nodes.row_size == 0)),
      nodes.turn.size(), nodes.size(), nodes.sectors, nodes.row_size);
  RONDO_DEMAND(model.contact->tributary.size() == model.contact->nodes.size(),
               model.contact->tributary.size(), model.contact->nodes.size());
  std::vector<int> candidate(model.n_nodes(), -1);
  const std::vector<int>& of = model.contact->nodes;
  for (std::size_t k = 0; k < of.size(); ++k) candidate[at(of[k])] = static_cast<int>(k);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes.node[i] < 0) continue;
    const int k = candidate[at(nodes.node[i])];
    if (k < 0) continue;
    candidates_.push_back({i, static_cast<std::size_t>(k)});
    is_held_[at(k)] = 1;
  }
  columns_.resize(nodes.sectors > 0 ? nodes.size() / nodes.row_size : candidates_.size());
  active_.reserve(2 * candidates_.size());
}

void ImplicitContact::fill_column(std::size_t of, ImplicitOperator& implicit) {
  const std::size_t place = candidates_[of].place;
  const bool ring = nodes_.sectors > 0;
  auto& column = columns_[ring ? place / nodes_.row_size : of];
  if (column[0].size() > 0) return;
  const std::size_t at = ring ? place / nodes_.row_size * nodes_.row_size : place;
  for (std::size_t component = 0; component < 2; ++component) {
    std::fill(unit_.x.begin(), unit_.x.end(), 0.0);
    std::fill(unit_.y.begin(), unit_.y.end(), 0.0);
    (component == 0 ? unit_.x : unit_.y)[at] = 1.0;
    implicit.solve(unit_);
    column[component] = PlaneField(ring ? nodes_.size() : candidates_.size());
    for (std::size_t i = 0; i < column[component].size(); ++i)
      column[component].put(i, unit_.at(ring ? i : candidates_[i].place));
  }
}

/// Velocity of one candidate per impulse on another, co-rotating frame, by rows.
Block ImplicitContact::response(std::size_t to, std::size_t from) const noexcept {
  const std::size_t i = candidates_[to].place, j = candidates_[from].place;
  const bool ring = nodes_.sectors > 0;
  std::size_t at = to;
  if (ring) {
    const std::size_t size = nodes_.row_size, n = static_cast<std::size_t>(nodes_.sectors);
    at = i / size * size + (i % size + n - j % size) % n;
  }
  const auto& column = columns_[ring ? j / nodes_.row_size : from];
  RONDO_ASSERT(at < column[0].size(), at, column[0].size());  // by fill_column()
  const Block local = {column[0].x[at], column[1].x[at], column[0].y[at], column[1].y[at]};
  return contact::in_frames(nodes_.turn[i], local, nodes_.turn[j]);
}

bool ImplicitContact::find(const ContactStep& step, const PlaneField& u, const PlaneField& before,
                           ImplicitOperator& implicit) {
  rows_.clear();
  active_.clear();
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const auto [place, k] = candidates_[c];
    const Complex turn = nodes_.turn[place];
    const Vec2 arm = turn * (nodes_.reference.at(place) + u.at(place));
    const contact::Touches touches =
        model_.contact->ground.touches(step.center + step.rotation * arm);
    if (touches.count > 0) fill_column(c, implicit);
    for (int t = 0; t < touches.count; ++t) {
      const contact::Touch& touch = touches.at[at(t)];
      ActiveContact a;
      a.candidate = k;
      a.normal = touch.normal;
      a.gap = touch.gap;
      a.before = to_frame(a.normal, velocity_before(step, arm, turn * before.at(place)));
      a.bounce = contact::restitution_shift(*step.law, a.before.x, a.before.x);
      rows_.push_back({c, key_bits | (2 * k + static_cast<std::uint64_t>(t)), arm});
      a.friction = friction_of(step, a, rows_.back());
      active_.push_back(a);
    }
  }
  if (rows_.empty()) {
    coupled_.kept.clear();
    return false;
  }
  build_problem(step);
  return true;
}

/// W_jl = n̄_j R(θ_{n+2}) A⁻¹_jl R(θ_{n+1})ᵀ n̄_lᵀ
void ImplicitContact::build_problem(const ContactStep& step) {
  coupled_.clear();
  for (std::size_t j = 0; j < rows_.size(); ++j)
    coupled_.add({}, active_[j].bounce, active_[j].friction, coupled_.kept_of(rows_[j].key));
  const auto block = [&](std::size_t j, std::size_t l) {
    const Complex to = conj(frame_of(active_[j].normal)) * step.rotation_next;
    const Complex from = conj(frame_of(active_[l].normal)) * step.rotation;
    return contact::in_frames(to, response(rows_[j].of, rows_[l].of), from);
  };
  coupled_.couple_all(block, largest_of);
}

double ImplicitContact::friction_of(const ContactStep& step, const ActiveContact& contact,
                                    const Row& row) const noexcept {
  const contact::Friction& friction = step.law->friction;
  if (friction.is_constant()) return friction.constant();
  const double length = model_.contact->tributary[contact.candidate];
  return friction.coefficient({step.center + step.rotation * row.arm, std::abs(contact.before.y),
                               coupled_.kept_of(row.key).x / (model_.dt * length)});
}

void ImplicitContact::solve(const ContactStep& step, const PlaneField& free, PlaneField& impulse) {
  RONDO_ASSERT(coupled_.problem.size() == rows_.size() && free.size() == nodes_.size(),
               coupled_.problem.size(), rows_.size(), free.size());  // by find()
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const std::size_t place = candidates_[rows_[j].of].place;
    const Vec2 velocity = nodes_.turn[place] * free.at(place);
    coupled_.problem.free[j] =
        to_frame(active_[j].normal, drive_of(step, rows_[j].arm) + step.rotation_next * velocity);
    active_[j].free = coupled_.problem.free[j];
  }
  coupled_.solve();
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const std::size_t place = candidates_[rows_[j].of].place;
    const Vec2 on_node = conj(nodes_.turn[place]) *
                         (conj(step.rotation) * from_frame(active_[j].normal, coupled_.impulse[j]));
    impulse.put(place, impulse.at(place) + on_node);
  }
}

void ImplicitContact::add_friction(const ContactStep& step, FrictionWork& work) const noexcept {
  for (std::size_t j = 0; j < rows_.size(); ++j)
    work.add(step.rotation * rows_[j].arm, {&active_[j], 1});
}

void ImplicitContact::report(const ContactStep& step, const PlaneField& before,
                             const PlaneField& after, ContactReport& report) {
  coupled_.kept.clear();
  const std::span<ActiveContact> all(active_);
  for (std::size_t j = 0; j < rows_.size();) {
    std::size_t end = j;
    for (; end < rows_.size() && rows_[end].of == rows_[j].of; ++end) {
      all[end].impulse = coupled_.impulse[end];
      all[end].status = coupled_.status[end];
      coupled_.kept.emplace_back(rows_[end].key, coupled_.impulse[end]);
    }
    const std::size_t place = candidates_[rows_[j].of].place, k = all[j].candidate;
    const Complex turn = nodes_.turn[place];
    const ContactNode node{k,
                           coupled_.problem.mass[j],
                           model_.contact->tributary[k],
                           rows_[j].arm,
                           turn * before.at(place),
                           {}};
    report_contacts(step, node, turn * after.at(place), all.subspan(j, end - j), report);
    j = end;
  }
  coupled_.sort_kept();
  if (rows_.size() > 1) ++report.clusters;
  report.clusters_not_converged += coupled_.result.converged ? 0 : 1;
  report.cluster_largest = std::max(report.cluster_largest, static_cast<int>(rows_.size()));
  report.cluster_iterations = std::max(report.cluster_iterations, coupled_.result.iterations);
}

}  // namespace rondo::dynamics
