// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps on a mesh of equal sectors: one sector's blocks, fields in polar components, sector
/// by sector contiguous, product, update and ledger in one pass over memory, many steps in one pass
/// where the fields are larger than the cache (docs/performance.md).
#pragma once
#include <memory>
#include <vector>

#include "rondo/integrators/fused/cyclic_chunk.hpp"
#include "rondo/integrators/fused/ring_integrator.hpp"
#include "rondo/integrators/fused/tail/massless_tail.hpp"

namespace rondo::dynamics {

class CyclicIntegrator : public RingIntegrator<CyclicChunk, CyclicPlan> {
 public:
  /// @pre model.sector is there. @throws std::bad_alloc
  CyclicIntegrator(const Model& model, const State& start, const kernels::Table& table,
                   const CyclicTuning& tuning = {});
  ~CyclicIntegrator() override;

 private:
  class Rows;
  NodesInStep rows_of(std::span<const int> nodes);
  void add_tails(const kernels::Table& table);
  void make_steps(const Batch& batch, Share share) noexcept override;
  void go_on(const kernels::WheelWay& way, long long step, Share share) noexcept override;
  void show_changes(Share share) noexcept override;
  [[nodiscard]] CandidateMotion motion_of(std::size_t candidate) const noexcept override;
  void move(std::size_t candidate, Vec3 v, Vec3 u) noexcept override;
  bool hold_within(std::span<const int> candidates) noexcept override;

  std::vector<std::unique_ptr<Rows>> rows_;  ///< rows as the tails see them
  std::size_t holder_ = 0;                   ///< the chunk that has all candidates near corners
};

}  // namespace rondo::dynamics
