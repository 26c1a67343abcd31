// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_chunk.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

SolidChunk::SolidChunk(const Model& model, const SolidPlan& plan, const kernels::SolidTable& table,
                       const CyclicChunkRange& range)
    : model_(model),
      plan_(plan),
      table_(table),
      range_(range),
      fields_(plan.chunk_size()),
      sums_(static_cast<std::size_t>(plan.cut.depth * kernels::n_sums * kernels::lanes) *
            range.n_groups),
      contact_(model.contact ? static_cast<std::size_t>(plan.cut.depth) * range.n_groups : 0) {
  const int n = plan.n_sectors;
  const auto columns = static_cast<int>(plan.stride) - 2 * halo_columns;
  RONDO_DEMAND(range.first >= 0 && range.columns > 0 && range.first + range.columns <= n &&
                   range.columns <= columns && range.n_groups > 0,
               range.first, range.columns, n, columns, range.n_groups);
  for (int c = -halo_columns; c < columns + halo_columns; ++c) {
    const int sector = ((range.first + c) % n + n) % n;
    const Complex turn = model.solid->sector.turn[static_cast<std::size_t>(sector)];
    turn_x_.push_back(turn.re);
    turn_y_.push_back(turn.im);
  }
  if (plan.cut.halo != Halo::ring)
    edges_ = RingEdges(plan.cut.halo, plan.keeps_force, plan.n_local, 3);
  if (!model.contact) return;
  const auto most = static_cast<std::size_t>(range.columns) + 2 * halo_columns;
  low_.resize(most + kernels::lanes);
  touching_.reserve(most * kernels::solid_rows);
  active_.reserve(2 * most * plan.candidate.size());
}

/// Shows the values of the chunk's own nodes where they are read for the next pass.
void SolidChunk::show_to_others() noexcept {
  if (plan_.cut.halo != Halo::ring) return give_edges();
  for (int a = 0; a < plan_.n_local; ++a) wrap(layout(), a, field_now());
}

double* SolidChunk::field(int row, int field) noexcept {
  return fields_.data() + CyclicPlan::lead + row * plan_.row_size() + field * plan_.stride;
}

Vec3 SolidChunk::at(int row, int field, int column) const noexcept {
  const double* x =
      fields_.data() + CyclicPlan::lead + row * plan_.row_size() + field * plan_.stride + column;
  return {x[0], x[plan_.stride], x[2 * plan_.stride]};
}

void SolidChunk::put(int row, int field, int column, Vec3 value) noexcept {
  double* x = this->field(row, field) + column;
  x[0] = value.x;
  x[plan_.stride] = value.y;
  x[2 * plan_.stride] = value.z;
}

int SolidChunk::field_now() const noexcept {
  return steps_ % 2 == 0 ? field_u_even : field_u_odd;
}

/// Force of the pressures on a node of a row, in its frame.
Vec3 SolidChunk::load_on(const Work& work, int row) const noexcept {
  Vec3 load;
  RONDO_ASSERT(plan_.loads.empty() || work.step->pressures, row, plan_.loads.size());
  for (std::size_t i = 0; i < plan_.loads.size(); ++i)
    load += work.step->pressures[i] * plan_.loads[i][static_cast<std::size_t>(row)];
  return load;
}

/// K u_0 by the very blocks of the steps: with others, alike to round-off, the ledger would begin
/// with their difference.
Vec3 SolidChunk::initial_force(const State& state, int row, int column) const noexcept {
  const fem::SolidSector& k = plan_.ordered.sector;
  const int n = plan_.n_sectors;
  Vec3 force;
  for (const SolidBlock& b : plan_.stiffness.blocks[static_cast<std::size_t>(row)]) {
    const auto of = static_cast<std::size_t>(b.row);
    const auto sector = static_cast<std::size_t>((range_.first + column + b.shift + n) % n);
    const std::size_t node = k.node(of, sector);
    const Complex frame = k.turn[sector] * plan_.stiffness.frame[of];
    const Vec3 u = conj(frame) * state.u.space()[node];
    force +=
        {b.k[0] * u.x + b.k[3] * u.y + b.k[6] * u.z, b.k[1] * u.x + b.k[4] * u.y + b.k[7] * u.z,
         b.k[2] * u.x + b.k[5] * u.y + b.k[8] * u.z};
  }
  return force;
}

template <class Visit>
void SolidChunk::for_own_nodes(Visit&& visit, bool candidates) const noexcept {
  for (int a = 0; a < plan_.n_local; ++a) {
    if (candidates && plan_.contact_row[static_cast<std::size_t>(a)] < 0) continue;
    for (int c = 0; c < range_.columns; ++c)
      visit(a, c,
            plan_.ordered.sector.node(static_cast<std::size_t>(a),
                                      static_cast<std::size_t>(std::ptrdiff_t{range_.first} + c)));
  }
}

void SolidChunk::load(const State& state) {
  for_own_nodes([&](int a, int c, std::size_t node) {
    const Complex to_node = conj(frame(a, c));
    const Vec3 v = to_node * state.v_next.space()[node];
    put(a, field_now(), c, to_node * state.u.space()[node] + model_.dt * v);
    put(a, field_v, c, v);
    if (plan_.keeps_force) put(a, field_force, c, initial_force(state, a, c));
  });
  show_to_others();
}

void SolidChunk::save(SavedState& saved) const noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) {
    saved.u.space()[node] = at(a, field_now(), c);
    saved.v.space()[node] = at(a, field_v, c);
    if (plan_.keeps_force) saved.force.space()[node] = at(a, field_force, c);
  });
}

void SolidChunk::restore(const SavedState& saved) noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) {
    put(a, field_now(), c, saved.u.space()[node]);
    put(a, field_v, c, saved.v.space()[node]);
    if (plan_.keeps_force) put(a, field_force, c, saved.force.space()[node]);
  });
  show_to_others();
}

void SolidChunk::save_displacement(bool candidates, std::span<Vec3> u) const noexcept {
  for_own_nodes(
      [&](int a, int c, std::size_t node) { u[node] = frame(a, c) * at(a, field_now(), c); },
      candidates);
}

void SolidChunk::save_velocity(std::span<Vec3> v) const noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) { v[node] = frame(a, c) * at(a, field_v, c); });
}

/// With a wide halo, step i of k leaves k - 1 - i columns of it right on each side.
SolidChunk::Extent SolidChunk::extent(std::size_t step, std::size_t n_steps) const noexcept {
  const int own = (range_.columns + kernels::lanes - 1) / kernels::lanes;
  const int beyond = static_cast<int>(n_steps - 1 - step);
  if (plan_.cut.halo != Halo::wide || beyond == 0) return {0, own, 0, range_.columns};
  const int last = (range_.columns + beyond + kernels::lanes - 1) / kernels::lanes;
  return {-1, last, -beyond, range_.columns + beyond};
}

SolidChunk::Work SolidChunk::work_of(std::span<const StepContext> steps,
                                     std::size_t i) const noexcept {
  const StepContext& step = steps[i];
  const bool even = (steps_ + static_cast<long long>(i)) % 2 == 0;
  return {&step,
          {step.factors, step.axial.pull, step.axial.inverse, step.axial.drag},
          extent(i, steps.size()),
          i,
          even ? field_u_even : field_u_odd,
          even ? field_u_odd : field_u_even,
          i + 1 == steps.size()};
}

kernels::SolidStrip SolidChunk::strip_of(const Work& work, const SolidPlanStrip& p) noexcept {
  kernels::SolidStrip s{};
  s.rows = plan_.rows.data() + p.first;
  s.n_rows = p.n_rows;
  s.kind = p.kind;
  s.entries = plan_.entries.data() + p.first_entry;
  s.n_entries = static_cast<int>(p.n_entries);
  s.blocks = plan_.numbers.data() + p.first_block;
  s.now = field(0, work.now);
  s.next = field(0, work.next);
  s.velocity = field(0, field_v);
  s.force = field(0, plan_.keeps_force ? field_force : field_v);  // else unused
  s.stride = plan_.stride;
  s.turn_x = turn_x_.data() + halo_columns;
  s.turn_y = turn_y_.data() + halo_columns;
  s.first_pack = work.extent.first_pack;
  s.last_pack = work.extent.last_pack;
  s.columns = range_.columns;
  s.keep_tail = plan_.cut.halo != Halo::wide;
  s.step = &work.factors;
  s.sums = sums_.data() + work.place * range_.n_groups *
                              static_cast<std::size_t>(kernels::n_sums * kernels::lanes);
  if (!plan_.loads.empty())
    for (int r = 0; r < p.n_rows; ++r) {
      const Vec3 load = load_on(work, p.first + r);
      s.load[r][0] = load.x, s.load[r][1] = load.y, s.load[r][2] = load.z;
    }
  return s;
}

void SolidChunk::strip(const Work& work, int i) noexcept {
  const SolidPlanStrip& p = plan_.strips[static_cast<std::size_t>(i)];
  touching_.clear();
  if (work.step->solid_contact)
    for (int a = p.first; a < p.first + p.n_rows; ++a)
      if (plan_.contact_row[static_cast<std::size_t>(a)] >= 0) find_touching(work, a);
  const kernels::Terms& terms = work.step->terms;
  table_.strip[!plan_.loads.empty()][terms.stiffness_damping][terms.unsteady](strip_of(work, p));
  for (const Touching& t : touching_) solve_node(work, t);
  if (plan_.cut.halo == Halo::ring)
    for (int a = p.first; a < p.first + p.n_rows; ++a) wrap(layout(), a, work.next);
}

void SolidChunk::pass(std::span<const StepContext> steps, PartialStep* parts,
                      std::size_t stride) noexcept {
  RONDO_ASSERT(!steps.empty() && steps.size() <= static_cast<std::size_t>(plan_.cut.depth),
               steps.size(), plan_.cut.depth);
  std::fill_n(sums_.data(), sums_.size(), 0.0);
  std::fill(contact_.begin(), contact_.end(), PartialStep{});
  active_.clear();
  const std::size_t n = steps.size();
  std::array<Work, solid_steps_in_a_pass> work;
  for (std::size_t i = 0; i < n; ++i) work[i] = work_of(steps, i);
  std::array<int, solid_steps_in_a_pass> done{};  // strips done by each step
  const int n_strips = static_cast<int>(plan_.strips.size());
  while (done[n - 1] < n_strips) {
    if (done[0] < n_strips) strip(work[0], done[0]++);
    // The others follow as far as they can.
    for (std::size_t i = 1; i < n; ++i)
      while (done[i] < n_strips &&
             plan_.strips[static_cast<std::size_t>(done[i])].needs < done[i - 1])
        strip(work[i], done[i]++);
  }
  steps_ += static_cast<long long>(n);
  ++passes_;
  hand_over(n, parts, stride);
}

void SolidChunk::hand_over(std::size_t n_steps, PartialStep* parts,
                           std::size_t stride) const noexcept {
  for (std::size_t i = 0; i < n_steps; ++i)
    for (std::size_t g = 0; g < range_.n_groups; ++g) {
      const std::size_t place = i * range_.n_groups + g;
      PartialStep& part = parts[i * stride + range_.first_group + g];
      part = contact_.empty() ? PartialStep{} : contact_[place];
      const double* sums = sums_.data() + place * kernels::n_sums * kernels::lanes;
      for (std::size_t k = 0; k < kernels::n_sums; ++k, sums += kernels::lanes)
        part.sums[k] += sum_of_lanes(sums);
    }
}

}  // namespace rondo::dynamics
