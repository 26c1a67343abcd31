// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps on a ring of equal sectors, chunk by chunk (ring_layout.hpp), of a disk and of a
/// wheel in three dimensions.
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/fused/batch_integrator.hpp"
#include "rondo/integrators/fused/ring_layout.hpp"

namespace rondo::dynamics {

/// @tparam Chunk a RingChunk with load() and pass()
/// @tparam Plan a RingLayout
template <class Chunk, class Plan>
class RingIntegrator : public BatchIntegrator {
 protected:
  template <class Table>
  RingIntegrator(const Model& model, const State& start, const Table& table, Plan plan)
      : BatchIntegrator(model, start, plan.cut.n_groups, plan.cut.chunks.size()),
        plan_(std::move(plan)) {
    chunks_.reserve(plan_.cut.chunks.size());
    for (const CyclicChunkRange& range : plan_.cut.chunks) {
      chunks_.emplace_back(model_, plan_, table, range);
      chunks_.back().load(start);
    }
  }

  /// A thread's chunks are the same in every pass; the others' edges are read only between two
  /// barriers, and written for the pass after. @param pass called with the number of a chunk, the
  /// steps, and where their parts are
  template <class Pass>
  void make_passes(const Batch& batch, Share share, Pass&& pass) noexcept {
    const std::size_t n = chunks_.size(), n_steps = batch.steps.size();
    const auto depth = static_cast<std::size_t>(plan_.cut.depth);
    const bool alone = plan_.cut.halo == Halo::ring;
    for (std::size_t done = 0; done < n_steps; done += depth) {
      const std::span steps = batch.steps.subspan(done, std::min(depth, n_steps - done));
      for (std::size_t c = share.first(n); c < share.last(n); ++c) {
        if (!alone) chunks_[c].take_halo(chunks_[(c + n - 1) % n], chunks_[(c + 1) % n]);
        pass(c, steps, batch.parts + done * n_parts_);
        if (!alone && !plan_.stepwise) chunks_[c].give_edges();
      }
      wait_for_others(share);
    }
  }

  void save_displacement(Nodes of, Field& u) const noexcept final {
    for (const Chunk& chunk : chunks_) chunk.save_displacement(of == Nodes::candidates, u);
  }
  void save_velocity(Field& v) const noexcept final {
    for (const Chunk& chunk : chunks_) chunk.save_velocity(v);
  }
  void save_fields(SavedState& saved) const noexcept override {
    for (const Chunk& chunk : chunks_) chunk.save(saved);
    if (!plan_.keeps_impulse) return;
    for (const Chunk& chunk : chunks_) chunk.save_impulses(saved.impulses);
    std::ranges::sort(saved.impulses, {}, [](const auto& kept) { return kept.first; });
  }
  void restore_fields(const SavedState& saved) noexcept override {
    for (Chunk& chunk : chunks_) chunk.restore(saved);
  }
  void save_active(std::vector<ActiveContact>& active) const noexcept final {
    for (const Chunk& chunk : chunks_)
      active.insert(active.end(), chunk.active().begin(), chunk.active().end());
  }

  /// The chunk whose own nodes are those of this sector.
  [[nodiscard]] std::size_t chunk_of(int sector) const noexcept {
    RONDO_ASSERT(sector >= 0 && sector < plan_.n_sectors, sector, plan_.n_sectors);
    const auto after =
        std::upper_bound(plan_.cut.chunks.begin(), plan_.cut.chunks.end(), sector,
                         [](int s, const CyclicChunkRange& chunk) { return s < chunk.first; });
    return static_cast<std::size_t>(after - plan_.cut.chunks.begin()) - 1;
  }

  const Plan plan_;
  std::vector<Chunk> chunks_;
};

}  // namespace rondo::dynamics
