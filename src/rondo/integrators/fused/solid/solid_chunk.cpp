// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_chunk.hpp"

#include <array>

#include "rondo/core/contract.hpp"
#include "rondo/model/solid/solid_rim.hpp"

namespace rondo::dynamics {

SolidChunk::SolidChunk(const Model& model, const SolidPlan& plan, const kernels::SolidTable& table,
                       const CyclicChunkRange& range)
    : RingChunk(model, plan, range, model.solid->sector.turn, kernels::solid_rows),
      plan_(plan),
      table_(table),
      faces_(plan.faces ? plan.faces->size(plan) : 0) {
  if (plan.rubber) window_.emplace(*plan.rubber, plan, range_);
}

/// Force of the pressures on a node of a row, in its frame.
Vec3 SolidChunk::load_on(const StepContext& step, int row) const noexcept {
  Vec3 load;
  RONDO_ASSERT(plan_.loads.empty() || step.pressures, row, plan_.loads.size());
  for (std::size_t i = 0; i < plan_.loads.size(); ++i)
    load += step.pressures[i] * plan_.loads[i][static_cast<std::size_t>(row)];
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

void SolidChunk::load(const State& state) {
  load_fields(state, [&](int a, int c) {
    if (!plan_.faces) return initial_force(state, a, c);
    return conj(frame(a, c)) * state.force.space()[plan_.node(a, range_.first + c)];
  });
  if (plan_.wheel) load_on_rim(state);
  show_to_others();
}

/// Sets the velocities that are carried, which are V in the axes of R_n; u_n stays.
void SolidChunk::load_on_rim(const State& state) {
  SolidRim rim(model_);
  rim.restore(state.step, state.rim);
  for_own_nodes([&](int a, int c, std::size_t node) {
    const Complex axes = frame(a, c), to_node = conj(axes);
    const Vec3 u = state.u.space()[node];
    const Vec3 place = axes * arm(a, to_node * u);
    put(a, field_next(), c, to_node * u);
    put(a, field_v, c, to_node * rim.velocity_of(place, model_.dt * state.v_next.space()[node]));
  });
}

/// Rows, fields and columns of a strip.
kernels::SolidStrip SolidChunk::strip_of(const SolidPlanStrip& p, int now, int next) noexcept {
  kernels::SolidStrip s{};
  s.rows = plan_.rows.data() + p.first;
  s.n_rows = p.n_rows;
  s.kind = p.kind;
  s.entries = plan_.entries.data() + p.first_entry;
  s.n_entries = static_cast<int>(p.n_entries);
  s.blocks = plan_.numbers.data() + p.first_block;
  set_fields(now, next, s);
  return s;
}

kernels::SolidStrip SolidChunk::strip_of(const Work& work, const SolidPlanStrip& p) noexcept {
  kernels::SolidStrip s = strip_of(p, work.now, work.next);
  set_work(work, s);
  s.step = &work.factors;
  s.swept = plan_.faces ? faces_.data() + RingLayout::lead : nullptr;
  s.rubber = window_ ? window_->forces() : nullptr;
  s.has_rubber = window_ ? window_->is_shown() : nullptr;
  s.n_sums = plan_.n_sums;
  if (!plan_.loads.empty())
    for (int r = 0; r < p.n_rows; ++r) {
      const Vec3 load = load_on(*work.step, p.first + r);
      s.load[r][0] = load.x, s.load[r][1] = load.y, s.load[r][2] = load.z;
    }
  return s;
}

/// The forces of cords and air at u_{n+1}.
void SolidChunk::find_faces(int now) noexcept {
  kernels::SolidFaces s = plan_.faces->faces();
  s.energy_of_state = plan_.energy_of_state;
  s.now = field(0, now);
  s.force = faces_.data() + RingLayout::lead;
  s.stride = plan_.stride;
  s.columns = range_.columns;
  s.n_sums = plan_.n_sums;
  s.sum = plan_.wheel ? int{kernels::wheel_linear} : int{kernels::sum_linear};
  s.sums = sums_of(0);
  table_.faces(s);
}

/// Those of the rubber beyond its tangent.
void SolidChunk::find_rubber(int now, double angle) noexcept {
  window_->find(table_, field(0, now), angle);
  if (plan_.wheel)
    window_->add_sums(sums_of(0), kernels::wheel_linear, kernels::wheel_window);
  else
    window_->add_sums(sums_of(0), kernels::sum_linear, kernels::sum_window);
}

void SolidChunk::strip(const Work& work, int i) noexcept {
  const SolidPlanStrip& p = plan_.strips[static_cast<std::size_t>(i)];
  touching_.clear();
  if (work.step->solid_contact)
    for (int a = p.first; a < p.first + p.n_rows; ++a)
      if (plan_.contact_row[static_cast<std::size_t>(a)] >= 0) find_touching(work, a);
  const kernels::Terms& terms = work.step->terms;
  if (plan_.wheel)
    table_.wheel->strip(strip_of(work, p));
  else
    table_.strip[!plan_.loads.empty()][plan_.keeps_force][terms.unsteady](strip_of(work, p));
  for (const Touching& t : touching_) solve_node(work, t);
  if (plan_.cut.halo == Halo::ring && !plan_.wheel)
    for (int a = p.first; a < p.first + p.n_rows; ++a) wrap(fields(), a, work.next);
}

void SolidChunk::pass(std::span<const StepContext> steps, PartialStep* parts,
                      std::size_t stride) noexcept {
  begin_pass();
  const std::size_t n = steps.size();
  std::array<Work, solid_steps_in_a_pass> work;
  for (std::size_t i = 0; i < n; ++i) {
    const AxialFactors& axial = steps[i].axial;
    work[i] = {step_in_pass(steps, i), {steps[i].factors, axial.pull, axial.inverse, axial.drag}};
  }
  if (plan_.faces) {
    RONDO_ASSERT(n == 1, n);
    find_faces(work[0].now);
    if (window_) find_rubber(work[0].now, steps[0].frame.angle);
  }
  walk(std::span<const Work>(work.data(), n), [this](const Work& w, int i) { strip(w, i); });
  end_pass(n, parts, stride);
}

void SolidChunk::go_on(const kernels::WheelWay& way) noexcept {
  RONDO_ASSERT(plan_.wheel && table_.wheel, plan_.wheel);
  const int next = field_next();
  for (const SolidPlanStrip& p : plan_.strips) {
    kernels::SolidStrip s = strip_of(p, field_now(), next);
    s.way = &way;
    table_.wheel->way(s);
  }
  ++steps_;
  show_to_others();
}

}  // namespace rondo::dynamics
