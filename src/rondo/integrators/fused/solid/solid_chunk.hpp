// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields of some sectors of a wheel in three dimensions, and their steps; on a loaded rim,
/// too.
#pragma once
#include <optional>
#include <span>

#include "rondo/integrators/fused/corners/held_contact.hpp"
#include "rondo/integrators/fused/ring_chunk.hpp"
#include "rondo/integrators/fused/solid/solid_plan.hpp"

namespace rondo::dynamics {

class SolidChunk : public RingChunk<3> {
 public:
  SolidChunk(const Model& model, const SolidPlan& plan, const kernels::SolidTable& table,
             const CyclicChunkRange& range);

  /// From u_n and v_{n+1/2} (state.v_next): u_{n+1} and, with β, K u_n.
  void load(const State& state);

  /// Makes the steps; parts[i * stride + g] gets what group g of the ring gives in step i.
  /// @pre the halo is taken
  void pass(std::span<const StepContext> steps, PartialStep* parts, std::size_t stride) noexcept;

  /// One of this chunk's own nodes, by row and sector, between two passes.
  [[nodiscard]] CandidateMotion motion_of(CyclicPlace place) const noexcept;
  void move(CyclicPlace place, Vec3 v, Vec3 u) noexcept;
  /// Force of the pressures on it, co-rotating frame [N].
  [[nodiscard]] Vec3 load_on(const StepContext& step, CyclicPlace place) const noexcept;

  /// Weights and energies of columns in a window (SolidWindow); there is one.
  void save_window(std::span<double> numbers) const noexcept { window_->save(numbers); }
  void restore_window(std::span<const double> numbers) noexcept { window_->restore(numbers); }

  /// On a loaded rim, after pass(): u_{n+2}, once the rim's own way is known; gives the edges.
  void go_on(const kernels::WheelWay& way) noexcept;

 private:
  struct Work : StepInPass {
    kernels::SolidFactors factors;
  };

  [[nodiscard]] Vec3 arm(int row, const Vec3& u) const noexcept {
    const kernels::SolidRow& r = plan_.rows[static_cast<std::size_t>(row)];
    return Vec3{r.x, r.y, r.z} + u;
  }
  [[nodiscard]] Vec3 load_on(const StepContext& step, int row) const noexcept;
  [[nodiscard]] Vec3 initial_force(const State& state, int row, int column) const noexcept;
  void load_on_rim(const State& state);
  void find_faces(int now) noexcept;
  void find_rubber(int now, double angle) noexcept;
  [[nodiscard]] kernels::SolidStrip strip_of(const SolidPlanStrip& p, int now, int next) noexcept;
  [[nodiscard]] kernels::SolidStrip strip_of(const Work& work, const SolidPlanStrip& p) noexcept;
  void strip(const Work& work, int i) noexcept;
  void find_touching(const Work& work, int row) noexcept;
  void solve_node(const Work& work, const Touching& t) noexcept;

  const SolidPlan& plan_;
  const kernels::SolidTable& table_;
  LargeArray faces_;                   ///< forces of cords and air
  std::optional<SolidWindow> window_;  ///< of nonlinear rubber
};

}  // namespace rondo::dynamics
