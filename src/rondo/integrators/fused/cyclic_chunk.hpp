// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields of some sectors of a disk, in polar components, and their steps.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/corner_contact.hpp"
#include "rondo/integrators/fused/cyclic_plan.hpp"
#include "rondo/integrators/fused/ring_edges.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/model/loaded_rim.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::dynamics {

class CyclicChunk {
 public:
  CyclicChunk(const Model& model, const CyclicPlan& plan, const kernels::Table& table,
              const CyclicChunkRange& range);

  /// From u_n and v_{n+1/2} (state.v_next): u_{n+1} and, with β, K u_n.
  void load(const State& state);
  /// This chunk's own nodes, in polar components.
  void save(SavedState& saved) const noexcept;
  void restore(const SavedState& saved) noexcept;
  /// u_{n+1} of this chunk's own nodes into u, v_{n+1/2} into v, (n) each.
  /// @param candidates only those of the rows that have contact candidates
  void save_displacement(bool candidates, std::span<Vec2> u) const noexcept;
  void save_velocity(std::span<Vec2> v) const noexcept;

  /// Gives the neighbours what they need of this chunk for the pass to come.
  void give_edges() noexcept { edges_.give(layout(), edge_fields(), passes_); }
  /// @pre the neighbours have made as many passes, or one more, and given their edges after each.
  void take_halo(const CyclicChunk& left, const CyclicChunk& right) noexcept {
    edges_.take(layout(), edge_fields(), passes_, left.edges_, right.edges_);
  }

  /// Makes the steps; parts[i * stride + g] gets what group g of the ring gives in step i.
  /// @param corners which hold nodes of this chunk alone; null: none. They fill the last part.
  /// @pre the halo is taken
  void pass(std::span<const StepContext> steps, PartialStep* parts, std::size_t stride,
            CornerContact* corners) noexcept;

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
    if (plan_.halo != Halo::ring) give_edges();
  }

  /// Contacts of the last step of the last pass, this chunk's own.
  [[nodiscard]] std::span<const ActiveContact> active() const noexcept { return active_; }

 private:
  static constexpr int group_columns = kernels::group_packs * kernels::lanes;
  /// Place of the first component of each field in a row; u of even and of odd steps.
  enum Field { field_u_even = 0, field_u_odd = 2, field_v = 4, field_force = 6 };
  static_assert(halo_columns == kernels::lanes);  // the halo on the left is pack -1
  /// Columns of the chunk that a step of a pass works on.
  struct Extent {
    int first_pack, last_pack;
    int first_column, last_column;  ///< whose values are right: contact is looked for there
  };
  /// A column that touches, and what its row held before the update.
  struct Touching {
    int row, column;
    contact::Touches touches;
    Vec2 v;
    Vec2 force;
  };

  [[nodiscard]] Extent extent(std::size_t step, std::size_t n_steps) const noexcept;
  [[nodiscard]] double* field(int row, int field) noexcept;
  [[nodiscard]] Vec2 at(int row, int field, int column) const noexcept;
  void put(int row, int field, int column, Vec2 value) noexcept;
  [[nodiscard]] Complex turn(int column) const noexcept {
    return {turn_x_[padded(column)], turn_y_[padded(column)]};
  }
  static std::size_t padded(int column) noexcept {
    return static_cast<std::size_t>(std::ptrdiff_t{column} + halo_columns);
  }
  /// The step in hand of a pass.
  struct Work {
    const StepContext* step;
    Extent extent;
    std::size_t place;       ///< number of the step in the pass
    int now, next;           ///< fields of u before and after the step
    bool last;               ///< the step is the last of the pass
    CornerContact* corners;  ///< null: none hold nodes of this chunk
    PartialStep* held;       ///< their part of the step
  };
  class InPass;  ///< the candidates during a step of a pass
  [[nodiscard]] CandidateMotion motion_of(CyclicPlace place, int field_u) const noexcept;
  void set_motion(CyclicPlace place, int field_u, Vec2 v, Vec2 u) noexcept;
  void fill_loads();
  [[nodiscard]] Vec2 load_on(const Work& work, int row, int column) const noexcept;
  [[nodiscard]] Vec2 initial_force(std::span<const Vec2> u, int a, int c) const noexcept;
  [[nodiscard]] kernels::CyclicStrip strip_from(int first, int now, int next) noexcept;
  void strip(const Work& work, int i) noexcept;
  [[nodiscard]] std::size_t candidate_at(int row, int column) const noexcept;
  void find_touching(const Work& work, int a) noexcept;
  void solve_node(const Work& work, const Touching& t) noexcept;
  void take_impulse(const Work& work, const Touching& t, const ContactNode& node, Vec2 after,
                    StepSums* sums) noexcept;
  /// visit(row, column, node) of this chunk's own nodes; `candidates`: of rows that have some
  /// alone.
  template <class Visit>
  void for_own_nodes(Visit&& visit, bool candidates = false) const noexcept;
  [[nodiscard]] int field_of(RowField which) const noexcept;
  void show_to_others() noexcept;
  [[nodiscard]] ChunkFields layout() noexcept {
    return {field(0, 0), plan_.row_size(), plan_.stride, plan_.n_local, 2, range_.columns};
  }
  void hand_over(std::size_t n_steps, PartialStep* parts, std::size_t stride) const noexcept;
  [[nodiscard]] int field_now() const noexcept;
  [[nodiscard]] int field_next() const noexcept;
  void load_on_rim(const State& state);
  [[nodiscard]] std::array<int, 3> edge_fields() const noexcept;

  const Model& model_;
  const CyclicPlan& plan_;
  const kernels::Table& table_;
  CyclicChunkRange range_;
  LargeArray fields_;
  std::vector<double> turn_x_, turn_y_;  ///< cos φ, sin φ of the columns, from the halo on the left
  LargeArray loads_;                     ///< (loads, 2) `stride` apart, as the plan has them  [m]
  LargeArray sums_;                      ///< (depth, groups, n_sums, lanes)
  std::vector<PartialStep> contact_;     ///< (depth, groups): of these the contacts' part
  RingEdges edges_;
  std::vector<int> low_;
  std::vector<Touching> touching_;
  std::vector<ActiveContact> active_;
  long long steps_ = 0;  ///< made so far: tells which field u is in; on a loaded rim by go_on()
  std::size_t passes_ = 0;
};

}  // namespace rondo::dynamics
