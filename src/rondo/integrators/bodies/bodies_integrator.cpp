// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/bodies/bodies_integrator.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/steps/step_table.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;
/// Fewer blocks than this are not worth a thread that waits for others four times a step.
constexpr std::size_t blocks_of_a_thread = 4;

int threads_of(const Model& model, const BodyPlan& plan) noexcept {
  RONDO_DEMAND(model.threads >= 1, model.threads);
  const std::size_t most = std::max<std::size_t>(1, plan.blocks.size() / blocks_of_a_thread);
  return std::min(model.threads, static_cast<int>(most));
}

}  // namespace

const kernels::BodyTable& body_table([[maybe_unused]] const kernels::Table& level) {
#ifdef RONDO_X86_KERNELS
  for (const kernels::BodyTable* table : {&kernels::avx512_bodies, &kernels::avx2_bodies})
    if (std::string_view(table->name) == level.name) return *table;
#endif
  return kernels::baseline_bodies;
}

BodiesIntegrator::BodiesIntegrator(const Model& model, const State& start,
                                   const kernels::BodyTable& table)
    : model_(model),
      table_(table),
      plan_(make_body_plan(model)),
      beta_(model.stiffness_damping > 0.0),
      threads_(threads_of(model, plan_)),
      motion_(plan_.n_packs * 4 * lanes),
      elastic_(plan_.n_packs * 2 * lanes),
      force_(plan_.n_packs * (beta_ ? 4 : 2) * lanes),
      loads_(model, plan_),
      step_(start.step),
      groups_(plan_.groups.size()),
      sums_(plan_.blocks.size()),
      poses_(start.poses),
      energy_(model.free_bodies.size()) {
  RONDO_DEMAND(can(StepKind::bodies, features_of(model)) && poses_.size() == energy_.size(),
               poses_.size(), energy_.size());
  RONDO_DEMAND(start.u.size() == model.n_nodes() && start.v_next.size() == model.n_nodes() &&
                   !plan_.groups.empty(),
               start.u.size(), start.v_next.size(), model.n_nodes(), plan_.groups.size());
  fields_ = {.start = plan_.matrix.start.data(),
             .blocks = plan_.matrix.blocks.data(),
             .column = plan_.matrix.column.data(),
             .constants = plan_.constants.data(),
             .motion = motion_.data(),
             .elastic = elastic_.data(),
             .force = force_.data(),
             .load_at = loads_.load_at(),
             .loads = loads_.loads()};
  if (has_candidates(model)) contact_.emplace(model);
  begin(start);
}

/// Into the rows.
void BodiesIntegrator::load(std::span<const Vec2> u, std::span<const Vec2> v) noexcept {
  for (std::size_t i = 0; i < plan_.node.size(); ++i) {
    if (plan_.node[i] < 0) continue;
    const auto node = static_cast<std::size_t>(plan_.node[i]);
    double* motion = motion_.data() + BodyPlan::at(static_cast<int>(i));
    motion[0] = u[node].x;
    motion[lanes] = u[node].y;
    motion[2 * lanes] = v[node].x;
    motion[3 * lanes] = v[node].y;
  }
}

void BodiesIntegrator::save_motion(std::span<Vec2> u, std::span<Vec2> v) const noexcept {
  RONDO_ASSERT(
      (u.empty() || u.size() == plan_.row.size()) && (v.empty() || v.size() == plan_.row.size()),
      u.size(), v.size(), plan_.row.size());
  for (std::size_t i = 0; i < plan_.node.size(); ++i) {
    if (plan_.node[i] < 0) continue;
    const auto node = static_cast<std::size_t>(plan_.node[i]);
    const double* motion = motion_.data() + BodyPlan::at(static_cast<int>(i));
    if (!u.empty()) u[node] = {motion[0], motion[lanes]};
    if (!v.empty()) v[node] = {motion[2 * lanes], motion[3 * lanes]};
  }
}

void BodiesIntegrator::fields(State& state) const noexcept {
  save_motion(state.u, state.v_next);
}

std::vector<contact::ProblemFile> BodiesIntegrator::take_difficult() {
  if (!contact_) return {};
  return contact_->coupled().difficult.take();
}

SavedState BodiesIntegrator::save() const {
  SavedState saved;
  saved.step = step_;
  saved.u = saved.v = Field(model_.n_nodes(), 2);
  save_motion(saved.u, saved.v);
  if (beta_) {
    saved.force = Field(model_.n_nodes(), 2);
    for (std::size_t i = 0; i < plan_.node.size(); ++i) {
      if (plan_.node[i] < 0) continue;
      const double* force = force_.data() + BodyPlan::at(static_cast<int>(i));
      saved.force.plane()[at(plan_.node[i])] = {force[0], force[lanes]};
    }
  }
  saved.energy = energy_;
  saved.poses = poses_;
  if (contact_) saved.impulses = contact_->coupled().kept;
  saved.ledger = ledger_.save();
  return saved;
}

void BodiesIntegrator::restore(const SavedState& saved) {
  const std::size_t n = model_.n_nodes();
  RONDO_DEMAND(saved.u.size() == n && saved.v.size() == n && (!beta_ || saved.force.size() == n),
               saved.u.size(), saved.v.size(), saved.force.size());
  RONDO_DEMAND(saved.energy.size() == energy_.size() && saved.poses.size() == energy_.size(),
               saved.energy.size(), saved.poses.size());
  step_ = saved.step;
  energy_ = saved.energy;
  poses_ = saved.poses;
  load(saved.u, saved.v);
  for (std::size_t i = 0; beta_ && i < plan_.node.size(); ++i) {
    if (plan_.node[i] < 0) continue;
    const Vec2 force = saved.force.plane()[at(plan_.node[i])];
    double* to = force_.data() + BodyPlan::at(static_cast<int>(i));
    to[0] = force.x;
    to[lanes] = force.y;
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) set_pose(plan_.groups[g], groups_[g]);
  // The sums of where it is: as they were, for no way adds to the displacements.
  const kernels::StepFactors stay{};
  for (std::size_t b = 0; b < plan_.blocks.size(); ++b) move(b, &stay);
  if (contact_) contact_->restore(saved.impulses);
  ledger_.restore(saved.ledger);
}

void BodiesIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  if (!last) return advance_batch(reports);
  if (reports.size() > 1) advance_batch(reports.first(reports.size() - 1));
  save_motion(last->u, last->v);
  advance_batch(reports.last(1));
  save_motion({}, last->v_next);
  last->step = step_;
  last->frame = frame_;
  last->poses = poses_;
  last->active.clear();
  if (contact_) last->active = contact_->active();
}

}  // namespace rondo::dynamics
