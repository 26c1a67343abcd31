// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields of some sectors of a ring, each vector along the axes of its own node, and the
/// order in which steps pass over them: what chunks of disks (C = 2 components) and of wheels in
/// three dimensions (C = 3) have in common.
#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/ring_edges.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::dynamics {

template <int C>
class RingChunk {
 public:
  using Vec = std::conditional_t<C == 2, Vec2, Vec3>;
  using Touches = std::conditional_t<C == 2, contact::Touches, contact::SpaceTouches>;

  /// This chunk's own nodes, along their axes.
  void save(SavedState& saved) const noexcept;
  /// Adds the impulses of its contacts, where they are kept, by candidate.
  void save_impulses(contact::KeptImpulses& impulses) const;
  void restore(const SavedState& saved) noexcept;
  /// u_{n+1} or v_{n+1/2} of this chunk's own nodes, in the co-rotating frame; (n).
  /// @param candidates only those of the rows that have contact candidates
  void save_displacement(bool candidates, std::span<Vec> u) const noexcept;
  void save_velocity(std::span<Vec> v) const noexcept;

  /// Gives the neighbours what they need of this chunk for the pass to come.
  void give_edges() noexcept { edges_.give(fields(), edge_fields(), passes_); }
  /// @pre the neighbours have made as many passes, or one more, and given their edges after each.
  void take_halo(const RingChunk& left, const RingChunk& right) noexcept {
    edges_.take(fields(), edge_fields(), passes_, left.edges_, right.edges_);
  }

  /// Contacts of the last step of the last pass, this chunk's own.
  [[nodiscard]] std::span<const ActiveContact> active() const noexcept { return active_; }

 protected:
  /// Place of the first component of each field in a row; u of even and of odd steps.
  enum Field { field_u_even = 0, field_u_odd = C, field_v = 2 * C, field_force = 3 * C };
  /// Columns of the chunk that a step of a pass works on.
  struct Extent {
    int first_pack, last_pack;
    int first_column, last_column;  ///< whose values are right: contact is looked for there
  };
  /// A step of a pass.
  struct StepInPass {
    const StepContext* step;
    Extent extent;
    std::size_t place;  ///< number of the step in the pass
    int now, next;      ///< fields of u before and after the step
    bool last;          ///< the step is the last of the pass
  };
  /// A column that touches, and what its row held before the update.
  struct Touching {
    int row, column;
    Touches touches;
    Vec v;
    Vec force;
    Vec kept;  ///< r_n of its contacts in the step before, where it is kept          [N·s/m], [N·s]
  };

  /// @param turn (N) axes of the sectors. @param strip_rows rows that are worked on together
  RingChunk(const Model& model, const RingLayout& layout, const CyclicChunkRange& range,
            std::span<const Complex> turn, std::size_t strip_rows);
  ~RingChunk() = default;
  RingChunk(RingChunk&&) noexcept = default;

  /// visit(row, column, node) of this chunk's own nodes.
  template <class Visit>
  void for_own_nodes(Visit&& visit, bool candidates = false) const noexcept;
  /// u_{n+1}, v_{n+1/2} and, where it is kept, K u_n = initial_force(row, column).
  template <class Force>
  void load_fields(const State& state, Force&& initial_force) noexcept;
  /// Shows the values of the chunk's own nodes where they are read for the next pass.
  void show_to_others() noexcept;

  void begin_pass() noexcept;
  [[nodiscard]] StepInPass step_in_pass(std::span<const StepContext> steps,
                                        std::size_t i) const noexcept;
  /// Calls strip(work[i], number) for all strips of all steps: each step follows the one before as
  /// far as it can.
  template <class Work, class Strip>
  void walk(std::span<const Work> work, Strip&& strip) noexcept;
  /// parts[i * stride + g] gets what group g of the ring gives in step i.
  void end_pass(std::size_t n_steps, PartialStep* parts, std::size_t stride) noexcept;

  [[nodiscard]] double* field(int row, int field) noexcept {
    return fields_.data() + place(row, field);
  }
  [[nodiscard]] const double* field(int row, int field) const noexcept {
    return fields_.data() + place(row, field);
  }
  [[nodiscard]] Vec at(int row, int field, int column) const noexcept {
    const double* x = this->field(row, field) + column;
    if constexpr (C == 2)
      return {x[0], x[layout_.stride]};
    else
      return {x[0], x[layout_.stride], x[2 * layout_.stride]};
  }
  void put(int row, int field, int column, Vec value) noexcept {
    double* x = this->field(row, field) + column;
    x[0] = value.x;
    x[layout_.stride] = value.y;
    if constexpr (C == 3) x[2 * layout_.stride] = value.z;
  }
  /// Sets what a strip knows of the fields; those of u are `now` and `next`.
  void set_fields(int now, int next, kernels::StripFields& strip) noexcept;
  /// Sets what a strip knows of a step of a pass.
  void set_work(const StepInPass& work, kernels::StripFields& strip) noexcept;
  /// Field of u_{n+1}, and that of the step to come.
  [[nodiscard]] int field_now() const noexcept {
    return steps_ % 2 == 0 ? field_u_even : field_u_odd;
  }
  [[nodiscard]] int field_next() const noexcept {
    return steps_ % 2 == 0 ? field_u_odd : field_u_even;
  }
  /// Axes of a column, and of a node of it, in the co-rotating frame.
  [[nodiscard]] Complex turn(int column) const noexcept {
    const auto c = static_cast<std::size_t>(std::ptrdiff_t{column} + halo_columns);
    return {turn_x_[c], turn_y_[c]};
  }
  [[nodiscard]] Complex frame(int row, int column) const noexcept {
    if constexpr (C == 2)  // the axes of its sector
      return turn(column);
    else
      return turn(column) * layout_.frame[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] const double* turn_x() const noexcept { return turn_x_.data() + halo_columns; }
  [[nodiscard]] const double* turn_y() const noexcept { return turn_y_.data() + halo_columns; }
  // What a law of friction asks for; nothing if friction is constant:
  /// r_n of the contacts of a node in the step before.
  [[nodiscard]] Vec kept_impulse(int row, int column) const noexcept {
    return layout_.keeps_impulse ? at(row, layout_.field_impulse(), column) : Vec{};
  }
  /// A row has no contact in a step but those that keep_impulse() tells.
  void forget_impulses(int row, const Extent& extent) noexcept;
  void keep_impulse(const Touching& t, std::span<const ActiveContact> contacts) noexcept;
  /// Pressures of the contacts of a node in the step before.
  [[nodiscard]] std::array<double, 2> pressures_before(const Touching& t,
                                                       double tributary) const noexcept {
    return {pressure_of(t.kept.x, tributary, model_.dt),
            pressure_of(t.kept.y, tributary, model_.dt)};
  }
  /// Place in ContactModel::nodes of a node of a contact row.
  [[nodiscard]] std::size_t candidate_at(int row, int column) const noexcept;
  [[nodiscard]] bool is_own(int column) const noexcept {
    return column >= 0 && column < range_.columns;
  }
  /// Sums of a step of a pass, group by group.
  [[nodiscard]] double* sums_of(std::size_t step) noexcept {
    return sums_.data() + step * range_.n_groups * lanes_of_group();
  }
  /// The contacts' part of a step, of the group of a column.
  [[nodiscard]] PartialStep& part_of(std::size_t step, int column) noexcept {
    return contact_[step * range_.n_groups +
                    static_cast<std::size_t>(column / layout_.group_columns)];
  }
  [[nodiscard]] ChunkFields fields() noexcept {
    return {field(0, 0), layout_.row_size(), layout_.stride, layout_.n_local, C, range_.columns};
  }

  const Model& model_;
  const CyclicChunkRange range_;
  std::vector<int> low_;
  std::vector<Touching> touching_;
  std::vector<ActiveContact> active_;
  long long steps_ = 0;  ///< made so far: tells which field u is in; on a loaded rim by go_on()

 private:
  [[nodiscard]] std::ptrdiff_t place(int row, int field) const noexcept {
    return RingLayout::lead + row * layout_.row_size() + field * layout_.stride;
  }
  [[nodiscard]] std::size_t lanes_of_group() const noexcept {
    return static_cast<std::size_t>(layout_.n_sums) * std::size_t{kernels::lanes};
  }
  [[nodiscard]] EdgeFields edge_fields() const noexcept {
    const int impulse = layout_.keeps_impulse ? layout_.field_impulse() : 0;
    return {field_now(), field_v, layout_.keeps_force ? int{field_force} : impulse, impulse};
  }
  void restore_impulses(const contact::KeptImpulses& impulses) noexcept;
  [[nodiscard]] Extent extent(std::size_t step, std::size_t n_steps) const noexcept;
  [[nodiscard]] double sum_of(const double* lanes) const noexcept;

  const RingLayout& layout_;
  LargeArray fields_;
  std::vector<double> turn_x_, turn_y_;  ///< cos φ, sin φ of the columns, from the halo on the left
  LargeArray sums_;                      ///< (depth, groups, n_sums, lanes)
  std::vector<PartialStep> contact_;     ///< (depth, groups): of these the contacts' part
  RingEdges edges_;
  std::size_t passes_ = 0;
};

template <int C>
template <class Visit>
void RingChunk<C>::for_own_nodes(Visit&& visit, bool candidates) const noexcept {
  const auto step = static_cast<std::size_t>(layout_.nodes_per_sector);
  for (int a = 0; a < layout_.n_local; ++a) {
    if (candidates && layout_.contact_row[static_cast<std::size_t>(a)] < 0) continue;
    std::size_t node = layout_.node(a, range_.first);
    for (int c = 0; c < range_.columns; ++c, node += step) visit(a, c, node);
  }
}

template <int C>
template <class Force>
void RingChunk<C>::load_fields(const State& state, Force&& initial_force) noexcept {
  const std::span<const Vec> u = state.u, v_next = state.v_next;
  for_own_nodes([&](int a, int c, std::size_t node) {
    const Complex to_node = conj(frame(a, c));
    const Vec v = to_node * v_next[node];
    put(a, field_now(), c, to_node * u[node] + model_.dt * v);
    put(a, field_v, c, v);
    if (layout_.keeps_force) put(a, field_force, c, initial_force(a, c));
    if (layout_.keeps_impulse) put(a, layout_.field_impulse(), c, {});
  });
}

template <int C>
template <class Work, class Strip>
void RingChunk<C>::walk(std::span<const Work> work, Strip&& strip) noexcept {
  const std::size_t n = work.size();
  RONDO_ASSERT(n > 0 && n <= static_cast<std::size_t>(layout_.cut.depth), n, layout_.cut.depth);
  std::array<int, halo_columns> done{};  // strips done by each step
  const auto n_strips = static_cast<int>(layout_.needs.size());
  while (done[n - 1] < n_strips) {
    if (done[0] < n_strips) strip(work[0], done[0]++);
    // The others follow as far as they can.
    for (std::size_t i = 1; i < n; ++i)
      while (done[i] < n_strips && layout_.needs[static_cast<std::size_t>(done[i])] < done[i - 1])
        strip(work[i], done[i]++);
  }
}

extern template class RingChunk<2>;
extern template class RingChunk<3>;

}  // namespace rondo::dynamics
