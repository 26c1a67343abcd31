// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"

namespace rondo::dynamics {

namespace {

SolidPlan plan_of(const Model& model, const kernels::SolidTable& table, const SolidTuning& tuning) {
  SolidPlan plan = make_solid_plan(model, tuning);
  set_state_of_faces(table, plan);
  return plan;
}

}  // namespace

SolidCyclicIntegrator::SolidCyclicIntegrator(const Model& model, const State& start,
                                             const kernels::Table& table, const SolidTuning& tuning)
    : RingIntegrator(model, start, *table.solid, plan_of(model, *table.solid, tuning)) {
  if (model.solid->swept) add_work(start);
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

CandidateMotion SolidCyclicIntegrator::motion_of(std::size_t) const noexcept {
  return {};
}

void SolidCyclicIntegrator::move(std::size_t, Vec2, Vec2) noexcept {}

}  // namespace rondo::dynamics
