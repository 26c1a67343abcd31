// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields of some sectors of a disk, in polar components, and their steps.
#pragma once
#include <span>

#include "rondo/integrators/fused/corners/held_contact.hpp"
#include "rondo/integrators/fused/cyclic_plan.hpp"
#include "rondo/integrators/fused/ring_chunk.hpp"
#include "rondo/model/loaded_rim.hpp"

namespace rondo::dynamics {

class CyclicChunk : public RingChunk<2> {
 public:
  CyclicChunk(const Model& model, const CyclicPlan& plan, const kernels::Table& table,
              const CyclicChunkRange& range);

  /// From u_n and v_{n+1/2} (state.v_next): u_{n+1} and, with β, K u_n.
  void load(const State& state);

  /// Makes the steps; parts[i * stride + g] gets what group g of the ring gives in step i.
  /// @param corners which hold nodes of this chunk alone; null: none. They fill the last part.
  /// @pre the halo is taken
  void pass(std::span<const StepContext> steps, PartialStep* parts, std::size_t stride,
            HeldContact* corners) noexcept;

  /// On a loaded rim, after pass(): u_{n+2}, once the rim's own way is known; gives the edges.
  void go_on(const kernels::WheelWay& way) noexcept;

  /// One of this chunk's own nodes, by row and sector, between two passes.
  [[nodiscard]] CandidateMotion motion_of(CyclicPlace place) const noexcept;
  void move(CyclicPlace place, Vec2 v, Vec2 u) noexcept;

  /// u_{n+1}, v_{n+1/2} or K u_n of a row between two passes: this chunk's own sectors, at their
  /// places in x and y, which are of the whole ring.
  enum class RowField { u, v, force };
  void copy_out(int row, RowField which, double* x, double* y) const noexcept;
  void copy_in(int row, RowField which, const double* x, const double* y) noexcept;
  /// After copy_in(), for the next pass.
  void show_rows() noexcept {
    if (plan_.cut.halo != Halo::ring) give_edges();
  }

 private:
  struct Work : StepInPass {
    HeldContact* corners;  ///< null: none hold nodes of this chunk
    PartialStep* held;     ///< their part of the step
  };
  class InPass;  ///< the candidates during a step of a pass
  [[nodiscard]] CandidateMotion motion_of(CyclicPlace place, int field_u) const noexcept;
  void set_motion(CyclicPlace place, int field_u, Vec2 v, Vec2 u) noexcept;
  void fill_loads();
  [[nodiscard]] Vec2 load_on(const Work& work, int row, int column) const noexcept;
  [[nodiscard]] Vec2 initial_force(std::span<const Vec2> u, int a, int c) const noexcept;
  [[nodiscard]] kernels::CyclicStrip strip_from(int first, int now, int next) noexcept;
  void strip(const Work& work, int i) noexcept;
  void find_touching(const Work& work, int a) noexcept;
  void solve_node(const Work& work, const Touching& t) noexcept;
  void take_impulse(const Work& work, const Touching& t, const ContactNode& node, Vec2 after,
                    StepSums* sums) noexcept;
  [[nodiscard]] int field_of(RowField which) const noexcept;
  void load_on_rim(const State& state);

  const CyclicPlan& plan_;
  const kernels::Table& table_;
  LargeArray loads_;  ///< (loads, 2) `stride` apart, as the plan has them  [m]
};

}  // namespace rondo::dynamics
