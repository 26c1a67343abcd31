// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/cyclic_chunk.hpp"

#include <algorithm>
#include <array>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

/// The block of a mirrored row on the layer below (-1), at (0) or above it, `shift` sectors on.
std::array<double, 4> mirrored_block(const kernels::MirrorRow& row, int layer, int shift) noexcept {
  const kernels::MirrorBlock& m = layer < 0 ? row.below : layer == 0 ? row.here : row.above;
  if (shift == 0) return {m.rr, 0.0, 0.0, m.tt};
  return {m.rr1, shift * m.tr1, shift * m.rt1, m.tt1};
}

}  // namespace

CyclicChunk::CyclicChunk(const Model& model, const CyclicPlan& plan, const kernels::Table& table,
                         const CyclicChunkRange& range)
    : RingChunk(model, plan, range, model.sector->turn, kernels::most_rows),
      plan_(plan),
      table_(table),
      loads_(plan.loads.empty()
                 ? 0
                 : static_cast<std::size_t>(RingLayout::lead +
                                            plan.stride * 2 * std::ssize(plan.loads))) {
  fill_loads();
}

/// The halo's too: it may be advanced along.
void CyclicChunk::fill_loads() {
  if (plan_.loads.empty()) return;
  const int n = plan_.n_sectors, columns = static_cast<int>(plan_.stride) - 2 * halo_columns;
  double* x = loads_.data() + RingLayout::lead;
  for (const CyclicLoad& load : plan_.loads) {
    for (int c = -halo_columns; c < columns; ++c) {
      const Vec2 force = load.force[static_cast<std::size_t>(((range_.first + c) % n + n) % n)];
      x[c] = force.x;
      x[c + plan_.stride] = force.y;
    }
    x += 2 * plan_.stride;
  }
}

/// Force on a node, in the sector's frame.
Vec2 CyclicChunk::load_on(const Work& work, int row, int column) const noexcept {
  const kernels::CyclicRow& r = plan_.rows[static_cast<std::size_t>(row)];
  const auto first = static_cast<std::ptrdiff_t>(plan_.first_load(row / kernels::most_rows));
  Vec2 load;
  for (std::ptrdiff_t i = first + r.first_load; i < first + r.first_load + r.n_loads; ++i) {
    const double* x = loads_.data() + RingLayout::lead + 2 * i * plan_.stride + column;
    load += work.step->pressures[plan_.load_of[static_cast<std::size_t>(i)]] *
            Vec2{x[0], x[plan_.stride]};
  }
  return load;
}

/// K u_0 by the very blocks of the steps: with others, alike to round-off, the ledger would begin
/// with their difference.
Vec2 CyclicChunk::initial_force(std::span<const Vec2> u, int a, int c) const noexcept {
  RONDO_ASSERT(u.size() == model_.n_nodes() && plan_.keeps_force, u.size(), model_.n_nodes());
  const fem::SectorStiffness& k = *model_.sector;
  const int n = plan_.n_sectors, sector = range_.first + c;
  Vec2 force;
  for (const fem::SectorStiffness::Entry& e : k.row(static_cast<std::size_t>(a))) {
    const auto there = static_cast<std::size_t>((sector + e.shift + n) % n);
    const Vec2 x = conj(k.turn[there]) * u[k.node(static_cast<std::size_t>(e.column), there)];
    std::array<double, 4> block = e.block;
    if (!plan_.mirror.empty())
      block = mirrored_block(plan_.mirror[static_cast<std::size_t>(a)], e.column - a, e.shift);
    force += {block[0] * x.x + block[2] * x.y, block[1] * x.x + block[3] * x.y};
  }
  return force;
}

void CyclicChunk::load(const State& state) {
  load_fields(state, [&](int a, int c) { return initial_force(state.u, a, c); });
  if (plan_.wheel) load_on_rim(state);
  show_to_others();
}

/// Sets the velocities that are carried, which are V in the axes of R_n; u_n stays.
void CyclicChunk::load_on_rim(const State& state) {
  LoadedRim rim(model_);
  rim.restore(state.step, state.rim);
  for_own_nodes([&](int a, int c, std::size_t node) {
    const Complex to_sector = conj(turn(c));
    const Vec2 arm = model_.reference[node] + state.u.plane()[node];
    put(a, field_next(), c, to_sector * state.u.plane()[node]);
    put(a, field_v, c, to_sector * rim.velocity_of(arm, model_.dt * state.v_next.plane()[node]));
  });
}

int CyclicChunk::field_of(RowField which) const noexcept {
  return which == RowField::u ? field_now() : which == RowField::v ? field_v : field_force;
}

void CyclicChunk::copy_out(int row, RowField which, double* x, double* y) const noexcept {
  RONDO_ASSERT(row >= 0 && row < plan_.n_local, row, plan_.n_local);
  const double* from = field(row, field_of(which));
  std::copy_n(from, range_.columns, x + range_.first);
  std::copy_n(from + plan_.stride, range_.columns, y + range_.first);
}

void CyclicChunk::copy_in(int row, RowField which, const double* x, const double* y) noexcept {
  RONDO_ASSERT(row >= 0 && row < plan_.n_local, row, plan_.n_local);
  double* to = field(row, field_of(which));
  std::copy_n(x + range_.first, range_.columns, to);
  std::copy_n(y + range_.first, range_.columns, to + plan_.stride);
  if (which == RowField::u && plan_.cut.halo == Halo::ring) wrap(fields(), row, field_now());
}

class CyclicChunk::InPass final : public CandidateFields {
 public:
  InPass(CyclicChunk& chunk, const Work& work) : chunk_(chunk), work_(work) {}

  [[nodiscard]] CandidateMotion motion_of(std::size_t candidate) const noexcept override {
    return chunk_.motion_of(chunk_.plan_.place[candidate], work_.now);
  }
  void move(std::size_t candidate, Vec3 v, Vec3 u) noexcept override {
    chunk_.set_motion(chunk_.plan_.place[candidate], work_.next, v.plane(), u.plane());
  }

 private:
  CyclicChunk& chunk_;
  const Work& work_;
};

/// Fields and columns of up to most_rows rows.
kernels::CyclicStrip CyclicChunk::strip_from(int first, int now, int next) noexcept {
  kernels::CyclicStrip s{};
  s.rows = plan_.rows.data() + first;
  s.n_rows = std::min(kernels::most_rows, plan_.n_local - first);
  s.mirror = plan_.mirror.empty() ? nullptr : plan_.mirror.data() + first;
  s.row_size = plan_.row_size();
  set_fields(now, next, s);
  return s;
}

void CyclicChunk::strip(const Work& work, int i) noexcept {
  const int first = i * kernels::most_rows;
  const int n = std::min(kernels::most_rows, plan_.n_local - first);
  InPass candidates(*this, work);
  if (work.corners && i == plan_.first_contact_strip) work.corners->find(*work.step, candidates);
  touching_.clear();
  if (work.step->contact && !has_massless_contact(model_))
    for (int a = first; a < first + n; ++a)
      if (plan_.contact_row[static_cast<std::size_t>(a)] >= 0) find_touching(work, a);
  kernels::CyclicStrip s = strip_from(first, work.now, work.next);
  set_work(work, s);
  s.lowest = first == 0;
  s.highest = first + n == plan_.n_local;
  s.step = &work.step->factors;
  const std::size_t load = plan_.first_load(i);
  const bool loaded = load < plan_.first_load(i + 1);
  s.loads = loaded ? loads_.data() + RingLayout::lead +
                         2 * static_cast<std::ptrdiff_t>(load) * plan_.stride
                   : nullptr;
  s.load_of = plan_.load_of.data() + load;
  s.pressures = work.step->pressures;
  const kernels::Terms& terms = work.step->terms;
  if (plan_.wheel)
    table_.wheel->strip[work.step->heavy](s);
  else
    table_.cyclic_strip[loaded][terms.stiffness_damping][terms.unsteady](s);
  for (const Touching& t : touching_) solve_node(work, t);
  if (plan_.cut.halo == Halo::ring && !plan_.wheel)
    for (int a = first; a < first + n; ++a) wrap(fields(), a, work.next);
  if (work.corners && i == plan_.last_contact_strip)
    work.corners->solve(*work.step, candidates, *work.held);
}

void CyclicChunk::pass(std::span<const StepContext> steps, PartialStep* parts, std::size_t stride,
                       HeldContact* corners) noexcept {
  begin_pass();
  const std::size_t n = steps.size();
  std::array<Work, most_steps_in_a_pass> work;
  for (std::size_t i = 0; i < n; ++i)
    work[i] = {step_in_pass(steps, i), corners, parts + (i + 1) * stride - 1};
  walk(std::span<const Work>(work.data(), n), [this](const Work& w, int i) { strip(w, i); });
  end_pass(n, parts, stride);
}

void CyclicChunk::go_on(const kernels::WheelWay& way) noexcept {
  RONDO_ASSERT(plan_.wheel && table_.wheel, plan_.wheel);
  const int next = field_next();
  for (int first = 0; first < plan_.n_local; first += kernels::most_rows) {
    kernels::CyclicStrip s = strip_from(first, field_now(), next);
    s.way = &way;
    table_.wheel->strip_way(s);
  }
  ++steps_;
  show_to_others();
}

}  // namespace rondo::dynamics
