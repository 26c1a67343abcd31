// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"

#include <algorithm>
#include <utility>

namespace rondo::dynamics {

SolidCyclicIntegrator::SolidCyclicIntegrator(const Model& model, const State& start,
                                             const kernels::Table& table, const SolidTuning& tuning)
    : SolidCyclicIntegrator(model, start, table, make_solid_plan(model, tuning)) {}

SolidCyclicIntegrator::SolidCyclicIntegrator(const Model& model, const State& start,
                                             const kernels::Table& table, SolidPlan plan)
    : BatchIntegrator(model, start, plan.cut.n_groups, plan.cut.chunks.size()),
      plan_(std::move(plan)) {
  chunks_.reserve(plan_.cut.chunks.size());
  for (const CyclicChunkRange& range : plan_.cut.chunks) {
    chunks_.emplace_back(model_, plan_, *table.solid, range);
    chunks_.back().load(start);
  }
}

/// As CyclicIntegrator::make_steps(): a thread's chunks are the same in every pass; the others'
/// edges are read only between two barriers, and written for the pass after.
void SolidCyclicIntegrator::make_steps(const Batch& batch, Share share) noexcept {
  const std::size_t n = chunks_.size(), n_steps = batch.steps.size();
  const auto depth = static_cast<std::size_t>(plan_.cut.depth);
  for (std::size_t done = 0; done < n_steps; done += depth) {
    const std::span steps = batch.steps.subspan(done, std::min(depth, n_steps - done));
    for (std::size_t c = share.first(n); c < share.last(n); ++c) {
      if (plan_.cut.halo != Halo::ring)
        chunks_[c].take_halo(chunks_[(c + n - 1) % n], chunks_[(c + 1) % n]);
      chunks_[c].pass(steps, batch.parts + done * n_parts_, n_parts_);
      if (plan_.cut.halo != Halo::ring) chunks_[c].give_edges();
    }
    wait_for_others(share);
  }
}

void SolidCyclicIntegrator::save_displacement(Nodes of, Field& u) const noexcept {
  for (const SolidChunk& chunk : chunks_) chunk.save_displacement(of == Nodes::candidates, u);
}

void SolidCyclicIntegrator::save_velocity(Field& v) const noexcept {
  for (const SolidChunk& chunk : chunks_) chunk.save_velocity(v);
}

void SolidCyclicIntegrator::save_fields(SavedState& saved) const noexcept {
  for (const SolidChunk& chunk : chunks_) chunk.save(saved);
}

void SolidCyclicIntegrator::restore_fields(const SavedState& saved) noexcept {
  for (SolidChunk& chunk : chunks_) chunk.restore(saved);
}

void SolidCyclicIntegrator::save_active(std::vector<ActiveContact>& active) const noexcept {
  for (const SolidChunk& chunk : chunks_)
    active.insert(active.end(), chunk.active().begin(), chunk.active().end());
}

void SolidCyclicIntegrator::go_on(const kernels::WheelWay&, long long, Share) noexcept {}

CandidateMotion SolidCyclicIntegrator::motion_of(std::size_t) const noexcept {
  return {};
}

void SolidCyclicIntegrator::move(std::size_t, Vec2, Vec2) noexcept {}

}  // namespace rondo::dynamics
