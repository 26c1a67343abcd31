// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fast step of a wheel in three dimensions: what cyclic_integrator.hpp is in the plane,
/// with three components.
#pragma once
#include "rondo/integrators/fused/ring_integrator.hpp"
#include "rondo/integrators/fused/solid/solid_chunk.hpp"

namespace rondo::dynamics {

class SolidCyclicIntegrator final : public RingIntegrator<SolidChunk, SolidPlan> {
 public:
  /// @pre model.solid, the scheme "symplectic"
  SolidCyclicIntegrator(const Model& model, const State& start, const kernels::Table& table,
                        const SolidTuning& tuning = {});

 private:
  void make_steps(const Batch& batch, Share share) noexcept override;
  void save_fields(SavedState& saved) const noexcept override;
  void restore_fields(const SavedState& saved) noexcept override;
  void go_on(const kernels::WheelWay& way, long long step, Share share) noexcept override;
  [[nodiscard]] CandidateMotion motion_of(std::size_t candidate) const noexcept override;
  void move(std::size_t candidate, Vec3 v, Vec3 u) noexcept override;
  [[nodiscard]] Vec3 pressed_by(const StepContext& step,
                                std::size_t candidate) const noexcept override;
};

}  // namespace rondo::dynamics
