// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/batch_integrator.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/fused/corners/corner_contact.hpp"
#include "rondo/integrators/fused/corners/solid_corner_contact.hpp"
#include "rondo/integrators/fused/cyclic_plan.hpp"
#include "rondo/integrators/fused/solid/solid_plan.hpp"
#include "rondo/integrators/fused/sparse_plan.hpp"
#include "rondo/integrators/general/step_traps.hpp"
#include "rondo/model/friction_work.hpp"
#include "rondo/model/solid/swept_part.hpp"

namespace rondo::dynamics {
namespace {

std::size_t n_tails(const Model& model) noexcept {
  return (model.implicit ? 1U : 0U) + (has_massless_contact(model) ? 1U : 0U);
}

constexpr std::size_t steps_at_once = 64;
/// Steps between two looks for sharp corners: few enough that a node comes no farther in them than
/// is looked around it, many enough that looking costs little.
constexpr std::size_t steps_between_looks = 16;

}  // namespace

BatchIntegrator::BatchIntegrator(const Model& model, const State& start, std::size_t n_parts,
                                 std::size_t n_pieces)
    : model_(model),
      n_parts_(n_parts + (has_sharp_corners(model) ? 1 : 0) + n_tails(model)),
      step_(start.step),
      threads_(std::min(model.threads, static_cast<int>(n_pieces))),
      n_pressures_(model.solid ? model.solid->pressures.size() : model.pressures.size()),
      steps_(has_sharp_corners(model) ? steps_between_looks : steps_at_once),
      pressures_(steps_.size() * n_pressures_),
      parts_(steps_.size() * n_parts_),
      rubber_energy_(steps_.size()) {
  // Corners and tails solve contacts of their own, whose impulses the others do not see.
  RONDO_DEMAND(!has_friction_law(model) || (!has_sharp_corners(model) && n_tails(model) == 0));
  RONDO_DEMAND(n_parts > 0 && threads_ >= 1, n_parts, n_pieces, model.threads);
  RONDO_DEMAND(start.u.size() == model.n_nodes() && start.v_next.size() == model.n_nodes() &&
                   start.u.components() == model.components(),
               start.u.size(), start.v_next.size(), start.u.components(), model.n_nodes());
  if (has_sharp_corners(model)) {
    if (model.solid)
      corners_ = std::make_unique<SolidCornerContact>(model);
    else
      corners_ = std::make_unique<CornerContact>(model);
  }
  if (!model.rim) return;
  rim_.emplace(model);
  rim_->restore(start.step, start.rim);
}

void BatchIntegrator::add_work(const State& start) {
  rubber_work_.emplace(model_, start);
  for (RubberEnergy& energy : rubber_energy_) energy.least = 1.0;  // unless elements say otherwise
}

void BatchIntegrator::set_rubber(RubberForces& forces, const State& start) {
  RONDO_DEMAND(model_.rubber && !rubber_forces_, model_.rubber.has_value());
  add_work(start);
  rubber_forces_ = &forces;
}

void BatchIntegrator::set_step(std::size_t i) noexcept {
  const long long n = step_ + static_cast<long long>(i) + 1;
  steps_[i] = step_context(model_, frame_step(model_.motion, n, model_.dt));
  set_pressures(i);
  for (const auto& tail : tails_)
    if (tail->held()) steps_[i].held = tail->held();
}

/// Those at the time of the step, which has its frame.
void BatchIntegrator::set_pressures(std::size_t i) noexcept {
  double* const pressures = pressures_.data() + i * n_pressures_;
  for (std::size_t l = 0; l < n_pressures_; ++l) {
    const Table& pressure =
        model_.solid ? model_.solid->pressures[l].pressure : model_.pressures[l].pressure;
    pressures[l] = pressure.at(steps_[i].frame.time);
  }
  steps_[i].pressures = pressures;
}

void BatchIntegrator::look_for_corners(std::span<StepContext> steps) noexcept {
  if (!corners_) return;
  corners_->look_out(steps, *this);
  within_ = corners_->any_near() && hold_within(corners_->nodes());
}

template <class Work>
void BatchIntegrator::in_all_threads(Work&& work) noexcept {
  if (threads_ > 1) {
#pragma omp parallel num_threads(threads_)
    {
      const StepTraps traps;
      work(Share{static_cast<std::size_t>(omp_get_thread_num()),
                 static_cast<std::size_t>(omp_get_num_threads())});
    }
  } else {
    const StepTraps traps;
    work(Share{});
  }
}

void BatchIntegrator::advance_batch(std::span<StepReport> reports) noexcept {
  RONDO_ASSERT(!reports.empty() && reports.size() <= steps_.size(), reports.size());
  if (rim_) return advance_on_rim(reports);
  for (std::size_t i = 0; i < reports.size(); ++i) set_step(i);
  const std::span steps = std::span(steps_).first(reports.size());
  look_for_corners(steps);
  if (corners_)
    for (std::size_t i = 0; i < steps.size(); ++i) parts_[(i + 1) * n_parts_ - 1] = {};
  const Batch batch{steps, parts_.data(), step_, rubber_energy_.data()};
  in_all_threads([&](Share share) { make_batch(batch, share); });
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const std::span parts = std::span<const PartialStep>(parts_).subspan(i * n_parts_, n_parts_);
    WholeStep whole = whole_step(model_, parts);
    StepReport& report = reports[i] = {};
    if (rubber_work_) report.material = rubber_work_->add(rubber_energy_[i], whole);
    ledger_.add(whole.energy);
    report.step = batch.first + static_cast<long long>(i) + 1;
    report.frame = steps_[i].frame;
    report.contact = whole.contact;
    report.balance = ledger_.last();
  }
  step_ = batch.first + static_cast<long long>(reports.size());
  if (corners_) reports.back().contact.unseen = corners_->unseen(*this, 0.0);
}

bool BatchIntegrator::hold_within(std::span<const int>) noexcept {
  return false;
}

void BatchIntegrator::add_tail(std::unique_ptr<StepTail> tail) {
  RONDO_DEMAND(tails_.size() < n_tails(model_) && !model_.rim && tail, tails_.size());
  tails_.push_back(std::move(tail));
}

std::size_t BatchIntegrator::part_of_tail(std::size_t tail) const noexcept {
  RONDO_ASSERT(tail < tails_.size(), tail, tails_.size());
  return n_parts_ - (corners_ ? 1 : 0) - tails_.size() + tail;
}

/// Makes the steps one by one where corners are near, or there are tails.
void BatchIntegrator::make_batch(const Batch& batch, Share share) noexcept {
  if (tails_.empty() && (!corners_ || !corners_->any_near() || within_))
    return make_steps(batch, share);
  for (std::size_t i = 0; i < batch.steps.size(); ++i)
    make_alone({batch.steps.subspan(i, 1), batch.parts + i * n_parts_,
                batch.first + static_cast<long long>(i), batch.rubber + i},
               share);
}

/// A step of its own: what corners hold is found before it and solved after it, as are the tails.
void BatchIntegrator::make_alone(const Batch& batch, Share share) noexcept {
  const StepContext& step = batch.steps.front();
  const bool corners = corners_ && corners_->any_near() && !within_;
  if (share.thread == 0) {
    if (corners) corners_->find(step, *this);
    for (const auto& tail : tails_) tail->before();
  }
  wait_for_others(share);
  make_steps(batch, share);
  if (share.thread == 0) {
    step_ = batch.first + 1;  // the others do not look at it
    for (std::size_t k = 0; k < tails_.size(); ++k)
      tails_[k]->after(step, batch.parts[part_of_tail(k)]);
    if (corners) corners_->solve(step, *this, batch.parts[n_parts_ - 1]);
  }
  if (tails_.empty()) return;
  wait_for_others(share);
  show_changes(share);
}

/// Frames of the steps to come if the rim went on as it does: where corners are looked for.
void BatchIntegrator::expect_steps(std::size_t n) noexcept {
  SolidRim expected = *rim_;
  for (std::size_t i = 0; i < n; ++i) {
    expected.move();
    steps_[i].frame = expected.frame();
  }
}

void BatchIntegrator::advance_on_rim(std::span<StepReport> reports) noexcept {
  const long long first = step_;
  FrameStep expected;
  if (corners_) {
    expect_steps(reports.size());
    expected = steps_[reports.size() - 1].frame;
    look_for_corners(std::span(steps_).first(reports.size()));
  }
  in_all_threads([&](Share share) { make_steps_on_rim(reports, first, share); });
  step_ = first + static_cast<long long>(reports.size());
  if (!corners_) return;
  const FrameStep& last = reports.back().frame;
  const double astray = norm(last.center - expected.center) +
                        std::abs(last.angle - expected.angle) * corners_->farthest();
  reports.back().contact.unseen = corners_->unseen(*this, astray);
}

/// Step by step: forces and impulses by all threads, the rim by one, places by all.
void BatchIntegrator::make_steps_on_rim(std::span<StepReport> reports, long long first,
                                        Share share) noexcept {
  RONDO_ASSERT(rim_ && tails_.empty(), tails_.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const long long before = first + static_cast<long long>(i);
    if (share.thread == 0) begin_step(before);
    wait_for_others(share);
    make_steps({std::span(steps_).first(1), parts_.data(), before, rubber_energy_.data()}, share);
    if (share.thread == 0) end_step(reports[i]);
    wait_for_others(share);
    go_on(way_, before, share);
    wait_for_others(share);
  }
}

void BatchIntegrator::begin_step(long long before) noexcept {
  step_ = before;
  const char* held = steps_.front().held;
  rim_->move();
  steps_.front() =
      wheel_context(model_, rim_->frame(), conj(rim_->plane().turn_before()), rim_->gravity());
  set_pressures(0);
  steps_.front().held = held;
  if (!corners_) return;
  parts_[n_parts_ - 1] = {};
  if (corners_->any_near() && !within_) corners_->find(steps_.front(), *this);
}

void BatchIntegrator::end_step(StepReport& report) noexcept {
  const StepContext& step = steps_.front();
  const std::span parts = std::span(parts_).first(n_parts_);
  if (corners_ && corners_->any_near() && !within_) corners_->solve(step, *this, parts.back());
  report = {};
  if (model_.contact)
    for (const PartialStep& part : parts) report.contact.add(part.contact);
  const StepSums sums = wheel_sums(parts);
  rim_->take(rim_force(step, sums));
  way_ = wheel_way(model_, *rim_);
  StepEnergy energy = wheel_energy(model_, step, sums, report.contact, *rim_);
  if (rubber_work_) report.material = rubber_work_->add(rubber_energy_.front(), sums, energy);
  ledger_.add(energy);
  report.step = step_ + 1;
  report.frame = rim_->frame();
  report.balance = ledger_.last();
  report.rim = rim_->plane().report();
}

void BatchIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  const std::size_t contacts = model_.contact ? 2 * model_.contact->nodes.size() : 0;
  if (last) RONDO_DEMAND(last->active.capacity() >= contacts, last->active.capacity(), contacts);
  RONDO_DEMAND(!last || (last->u.size() == model_.n_nodes() &&
                         (last->v.empty() || last->v.size() == model_.n_nodes())),
               last->u.size(), last->v.size(), model_.n_nodes());
  std::span before = reports.first(reports.size() - (last ? 1 : 0));
  while (!before.empty()) {
    const std::size_t n = std::min(before.size(), steps_.size());
    advance_batch(before.first(n));
    before = before.subspan(n);
    if (model_.friction_work) model_.friction_work->settle();
  }
  if (!last) return;
  const Nodes nodes = last->v.empty() ? Nodes::candidates : Nodes::free;
  save_displacement(nodes, last->u);
  if (nodes == Nodes::free) save_velocity(last->v);
  advance_batch(reports.last(1));
  if (model_.friction_work) model_.friction_work->settle();
  if (!last->v_next.empty()) save_velocity(last->v_next);
  last->active.clear();
  save_active(last->active);
  if (corners_) corners_->save_active(last->active);
  for (const auto& tail : tails_) tail->save_active(last->active);
  sort_by_candidate(last->active);
  last->step = step_;
  last->frame = reports.back().frame;
}

void BatchIntegrator::fields(State& state) const noexcept {
  save_displacement(Nodes::free, state.u);
  save_velocity(state.v_next);
}

SavedState BatchIntegrator::save() const {
  SavedState saved;
  saved.step = step_;
  const Field zero(model_.n_nodes(), model_.components());
  saved.u = saved.v = zero;
  if (keeps_force()) saved.force = zero;
  if (rim_) {
    saved.rim = rim_->save();
    saved.u_before = zero;
  }
  saved.window.resize(window_numbers(model_));
  save_fields(saved);
  if (corners_) saved.impulses = corners_->kept();
  for (const auto& tail : tails_) tail->save(saved);
  if (rubber_work_) {
    saved.internal_work = rubber_work_->save();
    if (!saved.window.empty()) rubber_work_->save_window(saved.window);
    if (rubber_forces_) rubber_forces_->save(saved.branches);
  }
  saved.ledger = ledger_.save();
  return saved;
}

void BatchIntegrator::restore(const SavedState& saved) {
  RONDO_DEMAND(saved.u.size() == model_.n_nodes() && saved.v.size() == model_.n_nodes(),
               saved.u.size(), saved.v.size());
  RONDO_DEMAND(saved.u.components() == model_.components() &&
                   (!rim_ || saved.u_before.size() == model_.n_nodes()) &&
                   (!keeps_force() || saved.force.size() == model_.n_nodes()),
               saved.u.components(), saved.u_before.size(), saved.force.size(), model_.n_nodes());
  RONDO_DEMAND(saved.window.size() == window_numbers(model_), saved.window.size());
  step_ = saved.step;
  if (rim_) rim_->restore(saved.step, saved.rim);
  restore_fields(saved);
  if (corners_) corners_->kept() = saved.impulses;
  for (const auto& tail : tails_) tail->restore(saved);
  if (rubber_work_) {
    rubber_work_->restore(saved.internal_work);
    if (!saved.window.empty()) rubber_work_->restore_window(saved.window);
    if (rubber_forces_) rubber_forces_->restore(saved.branches);
  }
  ledger_.restore(saved.ledger);
}

std::vector<contact::ProblemFile> BatchIntegrator::take_difficult() {
  std::vector<contact::ProblemFile> problems;
  if (corners_) problems = corners_->take_difficult();
  for (const auto& tail : tails_)
    for (contact::ProblemFile& problem : tail->take_difficult())
      problems.push_back(std::move(problem));
  return problems;
}

int most_threads(const Model& model) noexcept {
  if (model.solid) return static_cast<int>(n_solid_groups(model.solid->sector.n_sectors));
  RONDO_DEMAND(model.stiffness_operator != StiffnessOperator::cyclic || model.sector,
               model.free.size());
  return static_cast<int>(model.stiffness_operator == StiffnessOperator::cyclic
                              ? n_cyclic_groups(model.sector->n_sectors)
                              : n_sparse_blocks(model.free.size()));
}

}  // namespace rondo::dynamics
