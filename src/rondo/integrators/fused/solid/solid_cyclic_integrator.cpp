// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"

namespace rondo::dynamics {

SolidCyclicIntegrator::SolidCyclicIntegrator(const Model& model, const State& start,
                                             const kernels::Table& table, const SolidTuning& tuning)
    : RingIntegrator(model, start, *table.solid, make_solid_plan(model, tuning)) {}

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
