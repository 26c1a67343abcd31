// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steps on a mesh of equal sectors: one sector's blocks, fields in polar components, sector
/// by sector contiguous, product, update and ledger in one pass over memory, many steps in one pass
/// where the fields are larger than the cache (docs/performance.md).
#pragma once
#include <vector>

#include "rondo/core/barrier.hpp"
#include "rondo/dynamics/cyclic_chunk.hpp"
#include "rondo/dynamics/integrator.hpp"

namespace rondo::dynamics {

class CyclicIntegrator : public Integrator {
 public:
  /// @pre model.sector is there. @throws std::bad_alloc
  CyclicIntegrator(const Model& model, const State& start, const kernels::Table& table,
                   const CyclicTuning& tuning = {});

  void advance(std::span<StepReport> reports, State* last) noexcept override;
  void fields(State& state) const noexcept override;

 private:
  void advance_batch(std::span<StepReport> reports) noexcept;
  void make_steps(std::size_t n_steps) noexcept;
  void passes(std::size_t n_steps, std::size_t thread, std::size_t n_threads) noexcept;

  const Model& model_;
  CyclicPlan plan_;
  std::vector<CyclicChunk> chunks_;
  std::vector<StepContext> steps_;  ///< of a batch
  std::vector<PartialStep> parts_;  ///< (steps of a batch, groups of the ring)
  Barrier barrier_;
  Ledger ledger_;
  long long step_ = 0;  ///< number of the last step made
  unsigned pass_ = 0;   ///< number of the next pass
};

}  // namespace rondo::dynamics
