// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/implicit/implicit_contact.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

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
    : model_(model), nodes_(nodes), is_held_(model.contact->nodes.size()), unit_(nodes.size()) {
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
      rows_.push_back({c, key_bit | (2 * k + static_cast<std::uint64_t>(t)), arm});
      a.friction = friction_of(step, a, rows_.back());
      active_.push_back(a);
    }
  }
  if (rows_.empty()) {
    kept_.clear();
    return false;
  }
  build_problem(step);
  return true;
}

/// W_jl = n̄_j R(θ_{n+2}) A⁻¹_jl R(θ_{n+1})ᵀ n̄_lᵀ
void ImplicitContact::build_problem(const ContactStep& step) {
  const std::size_t n = rows_.size();
  problem_.free.resize(n);
  problem_.row_start.assign(1, 0);
  for (auto* numbers : {&problem_.bounce, &problem_.friction, &problem_.mass}) numbers->clear();
  problem_.column.clear();
  problem_.blocks.clear();
  for (std::size_t j = 0; j < n; ++j) {
    problem_.bounce.push_back(active_[j].bounce);
    problem_.friction.push_back(active_[j].friction);
    const Complex to = conj(frame_of(active_[j].normal)) * step.rotation_next;
    for (std::size_t l = 0; l < n; ++l) {
      const Complex from = conj(frame_of(active_[l].normal)) * step.rotation;
      problem_.column.push_back(static_cast<int>(l));
      problem_.blocks.push_back(contact::in_frames(to, response(rows_[j].of, rows_[l].of), from));
      if (l == j) problem_.mass.push_back(1.0 / largest_of(problem_.blocks.back()));
    }
    problem_.row_start.push_back(static_cast<int>(problem_.column.size()));
  }
  impulse_.clear();
  for (const Row& row : rows_) impulse_.push_back(warm_start(row.key));
  start_ = impulse_;
  status_.assign(n, contact::Status::open);
}

double ImplicitContact::friction_of(const ContactStep& step, const ActiveContact& contact,
                                    const Row& row) const noexcept {
  const contact::Friction& friction = step.law->friction;
  if (friction.is_constant()) return friction.constant();
  const double length = model_.contact->tributary[contact.candidate];
  return friction.coefficient({step.center + step.rotation * row.arm, std::abs(contact.before.y),
                               warm_start(row.key).x / (model_.dt * length)});
}

Vec2 ImplicitContact::warm_start(std::uint64_t key) const noexcept {
  const auto found = std::lower_bound(kept_.begin(), kept_.end(), key,
                                      [](const auto& kept, auto k) { return kept.first < k; });
  return found != kept_.end() && found->first == key ? found->second : Vec2{};
}

void ImplicitContact::solve(const ContactStep& step, const PlaneField& free, PlaneField& impulse) {
  RONDO_ASSERT(problem_.free.size() == rows_.size() && impulse_.size() == rows_.size() &&
                   free.size() == nodes_.size(),
               problem_.free.size(), impulse_.size(), rows_.size());  // by find()
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const std::size_t place = candidates_[rows_[j].of].place;
    const Vec2 velocity = nodes_.turn[place] * free.at(place);
    problem_.free[j] =
        to_frame(active_[j].normal, drive_of(step, rows_[j].arm) + step.rotation_next * velocity);
    active_[j].free = problem_.free[j];
  }
  const contact::CoupledLimits limits{.most_iterations = model_.coupled.most_iterations};
  result_ = contact::solve_coupled(problem_, limits, impulse_, status_, workspace_);
  difficult_.look_at(problem_, impulse_, start_, result_, model_.coupled.dump_above);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const std::size_t place = candidates_[rows_[j].of].place;
    const Vec2 on_node = conj(nodes_.turn[place]) *
                         (conj(step.rotation) * from_frame(active_[j].normal, impulse_[j]));
    impulse.put(place, impulse.at(place) + on_node);
  }
}

void ImplicitContact::report(const ContactStep& step, const PlaneField& before,
                             const PlaneField& after, ContactReport& report) {
  kept_.clear();
  const std::span<ActiveContact> all(active_);
  for (std::size_t j = 0; j < rows_.size();) {
    std::size_t end = j;
    for (; end < rows_.size() && rows_[end].of == rows_[j].of; ++end) {
      all[end].impulse = impulse_[end];
      all[end].status = status_[end];
      kept_.emplace_back(rows_[end].key, impulse_[end]);
    }
    const std::size_t place = candidates_[rows_[j].of].place, k = all[j].candidate;
    const Complex turn = nodes_.turn[place];
    const ContactNode node{
        k, problem_.mass[j], model_.contact->tributary[k], rows_[j].arm, turn * before.at(place),
        {}};
    report_contacts(step, node, turn * after.at(place), all.subspan(j, end - j), report);
    j = end;
  }
  std::sort(kept_.begin(), kept_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  if (rows_.size() > 1) ++report.clusters;
  report.clusters_not_converged += result_.converged ? 0 : 1;
  report.cluster_largest = std::max(report.cluster_largest, static_cast<int>(rows_.size()));
  report.cluster_iterations = std::max(report.cluster_iterations, result_.iterations);
}

}  // namespace rondo::dynamics
