// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"

#include <span>
#include <vector>

#include "rondo/model/solid/swept_part.hpp"

namespace rondo::dynamics {

namespace {

SolidPlan plan_of(const Model& model, const kernels::SolidTable& table, const SolidTuning& tuning) {
  SolidPlan plan = make_solid_plan(model, tuning);
  set_state_of_faces(table, plan);
  if (model.solid->swept && model.solid->swept->rubber)
    plan.rubber = make_rubber_plan(model, plan, table);
  return plan;
}

}  // namespace

SolidCyclicIntegrator::SolidCyclicIntegrator(const Model& model, const State& start,
                                             const kernels::Table& table, const SolidTuning& tuning)
    : RingIntegrator(model, start, *table.solid, plan_of(model, *table.solid, tuning)) {
  if (!model.solid->swept) return;
  add_work(start);
  if (!plan_.rubber) return;
  SweptWheel wheel = swept_wheel(model);
  std::vector<Vec3> force(model.n_nodes());
  wheel.find(start.u, start.frame.angle, force);
  std::vector<double> numbers;
  wheel.save(numbers);
  for (SolidChunk& chunk : chunks_) chunk.restore_window(numbers);
}

void SolidCyclicIntegrator::save_fields(SavedState& saved) const noexcept {
  RingIntegrator::save_fields(saved);
  if (!saved.window.empty())
    for (const SolidChunk& chunk : chunks_) chunk.save_window(std::span(saved.window).subspan(2));
}

void SolidCyclicIntegrator::restore_fields(const SavedState& saved) noexcept {
  RingIntegrator::restore_fields(saved);
  if (!saved.window.empty())
    for (SolidChunk& chunk : chunks_) chunk.restore_window(std::span(saved.window).subspan(2));
}

void SolidCyclicIntegrator::make_steps(const Batch& batch, Share share) noexcept {
  make_passes(batch, share,
              [&](std::size_t c, std::span<const StepContext> steps, PartialStep* parts) {
                chunks_[c].pass(steps, parts, n_parts_);
              });
}

void SolidCyclicIntegrator::go_on(const kernels::WheelWay& way, long long /*step*/,
                                  Share share) noexcept {
  const std::size_t n = chunks_.size();
  for (std::size_t c = share.first(n); c < share.last(n); ++c) chunks_[c].go_on(way);
}

CandidateMotion SolidCyclicIntegrator::motion_of(std::size_t candidate) const noexcept {
  const CyclicPlace place = plan_.place[candidate];
  return chunks_[chunk_of(place.sector)].motion_of(place);
}

void SolidCyclicIntegrator::move(std::size_t candidate, Vec3 v, Vec3 u) noexcept {
  const CyclicPlace place = plan_.place[candidate];
  chunks_[chunk_of(place.sector)].move(place, v, u);
}

Vec3 SolidCyclicIntegrator::pressed_by(const StepContext& step,
                                       std::size_t candidate) const noexcept {
  const CyclicPlace place = plan_.place[candidate];
  return chunks_[chunk_of(place.sector)].load_on(step, place);
}

}  // namespace rondo::dynamics
