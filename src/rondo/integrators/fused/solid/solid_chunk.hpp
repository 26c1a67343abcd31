// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields of some sectors of a wheel in three dimensions, each vector in the frame of its
/// own node, and their steps: as cyclic_chunk.hpp, with three components.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/ring_edges.hpp"
#include "rondo/integrators/fused/solid/solid_plan.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::dynamics {

class SolidChunk {
 public:
  SolidChunk(const Model& model, const SolidPlan& plan, const kernels::SolidTable& table,
             const CyclicChunkRange& range);

  /// From u_n and v_{n+1/2} (state.v_next): u_{n+1} and, with β, K u_n.
  void load(const State& state);
  /// This chunk's own nodes, in the frames of their nodes.
  void save(SavedState& saved) const noexcept;
  void restore(const SavedState& saved) noexcept;
  /// u_{n+1} or v_{n+1/2} of this chunk's own nodes, in the co-rotating frame; (n).
  /// @param candidates only those of the rows that have contact candidates
  void save_displacement(bool candidates, std::span<Vec3> u) const noexcept;
  void save_velocity(std::span<Vec3> v) const noexcept;

  /// Gives the neighbours what they need of this chunk for the pass to come.
  void give_edges() noexcept { edges_.give(layout(), edge_fields(), passes_); }
  /// @pre the neighbours have made as many passes, or one more, and given their edges after each.
  void take_halo(const SolidChunk& left, const SolidChunk& right) noexcept {
    edges_.take(layout(), edge_fields(), passes_, left.edges_, right.edges_);
  }

  /// Makes the steps; parts[i * stride + g] gets what group g of the ring gives in step i.
  /// @pre the halo is taken
  void pass(std::span<const StepContext> steps, PartialStep* parts, std::size_t stride) noexcept;

  /// Contacts of the last step of the last pass, this chunk's own.
  [[nodiscard]] std::span<const ActiveContact> active() const noexcept { return active_; }

 private:
  /// Place of the first component of each field in a row; u of even and of odd steps.
  enum Field { field_u_even = 0, field_u_odd = 3, field_v = 6, field_force = 9 };
  /// Columns of the chunk that a step of a pass works on.
  struct Extent {
    int first_pack, last_pack;
    int first_column, last_column;  ///< whose values are right: contact is looked for there
  };
  /// A column that touches, and what its row held before the update.
  struct Touching {
    int row, column;
    contact::Touches touches;
    Vec3 v;
    Vec3 force;
  };
  /// The step in hand of a pass.
  struct Work {
    const StepContext* step;
    kernels::SolidFactors factors;
    Extent extent;
    std::size_t place;  ///< number of the step in the pass
    int now, next;      ///< fields of u before and after the step
    bool last;          ///< the step is the last of the pass
  };

  [[nodiscard]] Extent extent(std::size_t step, std::size_t n_steps) const noexcept;
  [[nodiscard]] Work work_of(std::span<const StepContext> steps, std::size_t i) const noexcept;
  [[nodiscard]] double* field(int row, int field) noexcept;
  [[nodiscard]] Vec3 at(int row, int field, int column) const noexcept;
  void put(int row, int field, int column, Vec3 value) noexcept;
  /// The frame of a node, as a rotation of the co-rotating frame.
  [[nodiscard]] Complex frame(int row, int column) const noexcept {
    const kernels::SolidRow& r = plan_.rows[static_cast<std::size_t>(row)];
    const auto c = static_cast<std::size_t>(std::ptrdiff_t{column} + halo_columns);
    return Complex{turn_x_[c], turn_y_[c]} * Complex{r.turn_x, r.turn_y};
  }
  [[nodiscard]] Vec3 arm(int row, const Vec3& u) const noexcept {
    const kernels::SolidRow& r = plan_.rows[static_cast<std::size_t>(row)];
    return Vec3{r.x, r.y, r.z} + u;
  }
  [[nodiscard]] Vec3 load_on(const Work& work, int row) const noexcept;
  [[nodiscard]] Vec3 initial_force(const State& state, int row, int column) const noexcept;
  [[nodiscard]] kernels::SolidStrip strip_of(const Work& work, const SolidPlanStrip& p) noexcept;
  void strip(const Work& work, int i) noexcept;
  [[nodiscard]] std::size_t candidate_at(int row, int column) const noexcept;
  void find_touching(const Work& work, int row) noexcept;
  void solve_node(const Work& work, const Touching& t) noexcept;
  void correct_sums(const Work& work, const Touching& t, Vec3 free, Vec3 after,
                    StepSums& sums) const noexcept;
  /// visit(row, column, node) of this chunk's own nodes.
  template <class Visit>
  void for_own_nodes(Visit&& visit, bool candidates = false) const noexcept;
  void show_to_others() noexcept;
  [[nodiscard]] ChunkFields layout() noexcept {
    return {field(0, 0), plan_.row_size(), plan_.stride, plan_.n_local, 3, range_.columns};
  }
  void hand_over(std::size_t n_steps, PartialStep* parts, std::size_t stride) const noexcept;
  [[nodiscard]] int field_now() const noexcept;
  [[nodiscard]] std::array<int, 3> edge_fields() const noexcept {
    return {field_now(), field_v, field_force};
  }

  const Model& model_;
  const SolidPlan& plan_;
  const kernels::SolidTable& table_;
  CyclicChunkRange range_;
  LargeArray fields_;
  std::vector<double> turn_x_, turn_y_;  ///< cos φ, sin φ of the columns, from the halo on the left
  LargeArray sums_;                      ///< (depth, groups, n_sums, lanes)
  std::vector<PartialStep> contact_;     ///< (depth, groups): of these the contacts' part
  RingEdges edges_;
  std::vector<int> low_;
  std::vector<Touching> touching_;
  std::vector<ActiveContact> active_;
  long long steps_ = 0;  ///< made so far: tells which field u is in
  std::size_t passes_ = 0;
};

}  // namespace rondo::dynamics
