// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/cyclic_chunk.hpp"

#include <algorithm>

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
    : model_(model),
      plan_(plan),
      table_(table),
      range_(range),
      fields_(plan.chunk_size()),
      loads_(plan.loads.empty() ? 0
                                : static_cast<std::size_t>(
                                      CyclicPlan::lead + plan.stride * 2 * std::ssize(plan.loads))),
      sums_(static_cast<std::size_t>(plan.depth * plan.n_sums() * kernels::lanes) * range.n_groups),
      contact_(model.contact ? static_cast<std::size_t>(plan.depth) * range.n_groups : 0) {
  const int n = plan.n_sectors;
  const auto columns = static_cast<int>(plan.stride) - 2 * halo_columns;
  RONDO_DEMAND(range.first >= 0 && range.columns > 0 && range.first + range.columns <= n &&
                   range.columns <= columns && range.n_groups > 0,
               range.first, range.columns, n, columns, range.n_groups);
  RONDO_DEMAND(model.sector && model.sector->turn.size() == static_cast<std::size_t>(n) &&
                   model.sector->n_local() == static_cast<std::size_t>(plan.n_local),
               n, plan.n_local);
  for (int c = -halo_columns; c < columns + halo_columns; ++c) {
    const int sector = ((range.first + c) % n + n) % n;
    turn_x_.push_back(model.sector->turn[static_cast<std::size_t>(sector)].re);
    turn_y_.push_back(model.sector->turn[static_cast<std::size_t>(sector)].im);
  }
  fill_loads();
  if (plan.halo != Halo::ring) edges_ = RingEdges(plan.halo, plan.keeps_force, plan.n_local, 2);
  if (!model.contact) return;
  const auto most = static_cast<std::size_t>(range.columns) + 2 * halo_columns;
  low_.resize(most + kernels::lanes);
  touching_.reserve(most * kernels::most_rows);
  active_.reserve(2 * most * plan.candidate.size());
}

/// The halo's too: it may be advanced along.
void CyclicChunk::fill_loads() {
  if (plan_.loads.empty()) return;
  const int n = plan_.n_sectors, columns = static_cast<int>(plan_.stride) - 2 * halo_columns;
  double* x = loads_.data() + CyclicPlan::lead;
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
    const double* x = loads_.data() + CyclicPlan::lead + 2 * i * plan_.stride + column;
    load += work.step->pressures[plan_.load_of[static_cast<std::size_t>(i)]] *
            Vec2{x[0], x[plan_.stride]};
  }
  return load;
}

double* CyclicChunk::field(int row, int field) noexcept {
  return fields_.data() + CyclicPlan::lead + row * plan_.row_size() + field * plan_.stride;
}

Vec2 CyclicChunk::at(int row, int field, int column) const noexcept {
  const double* x =
      fields_.data() + CyclicPlan::lead + row * plan_.row_size() + field * plan_.stride + column;
  return {x[0], x[plan_.stride]};
}

void CyclicChunk::put(int row, int field, int column, Vec2 value) noexcept {
  double* x = this->field(row, field) + column;
  x[0] = value.x;
  x[plan_.stride] = value.y;
}

int CyclicChunk::field_now() const noexcept {
  return steps_ % 2 == 0 ? field_u_even : field_u_odd;
}

/// u of the step to come; on a loaded rim it still is that of the step before.
int CyclicChunk::field_next() const noexcept {
  return steps_ % 2 == 0 ? field_u_odd : field_u_even;
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

template <class Visit>
void CyclicChunk::for_own_nodes(Visit&& visit, bool candidates) const noexcept {
  for (int a = 0; a < plan_.n_local; ++a) {
    if (candidates && plan_.contact_row[static_cast<std::size_t>(a)] < 0) continue;
    for (int c = 0; c < range_.columns; ++c)
      visit(a, c,
            model_.sector->node(static_cast<std::size_t>(a),
                                static_cast<std::size_t>(std::ptrdiff_t{range_.first} + c)));
  }
}

void CyclicChunk::load(const State& state) {
  for_own_nodes([&](int a, int c, std::size_t node) {
    const Complex to_sector = conj(turn(c));
    const Vec2 v = to_sector * state.v_next.plane()[node];
    put(a, field_now(), c, to_sector * state.u.plane()[node] + model_.dt * v);
    put(a, field_v, c, v);
    if (plan_.keeps_force) put(a, field_force, c, initial_force(state.u, a, c));
  });
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
    put(a, field_v, c,
        to_sector * velocity_on_rim(rim, model_.dt, arm, model_.dt * state.v_next.plane()[node]));
  });
}

void CyclicChunk::restore(const SavedState& saved) noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) {
    put(a, field_now(), c, saved.u.plane()[node]);
    put(a, field_v, c, saved.v.plane()[node]);
    if (plan_.keeps_force) put(a, field_force, c, saved.force.plane()[node]);
    if (plan_.wheel) put(a, field_next(), c, saved.u_before.plane()[node]);
  });
  show_to_others();
}

int CyclicChunk::field_of(RowField which) const noexcept {
  return which == RowField::u ? field_now() : which == RowField::v ? field_v : field_force;
}

void CyclicChunk::copy_out(int row, RowField which, double* x, double* y) const noexcept {
  RONDO_ASSERT(row >= 0 && row < plan_.n_local, row, plan_.n_local);
  const double* from =
      fields_.data() + CyclicPlan::lead + row * plan_.row_size() + field_of(which) * plan_.stride;
  std::copy_n(from, range_.columns, x + range_.first);
  std::copy_n(from + plan_.stride, range_.columns, y + range_.first);
}

void CyclicChunk::copy_in(int row, RowField which, const double* x, const double* y) noexcept {
  RONDO_ASSERT(row >= 0 && row < plan_.n_local, row, plan_.n_local);
  double* to = field(row, field_of(which));
  std::copy_n(x + range_.first, range_.columns, to);
  std::copy_n(y + range_.first, range_.columns, to + plan_.stride);
  if (which == RowField::u && plan_.halo == Halo::ring) wrap(layout(), row, field_now());
}

/// Shows the values of the chunk's own nodes where they are read for the next pass.
void CyclicChunk::show_to_others() noexcept {
  if (plan_.halo != Halo::ring) return give_edges();
  for (int a = 0; a < plan_.n_local; ++a) wrap(layout(), a, field_now());
}

void CyclicChunk::save(SavedState& saved) const noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) {
    saved.u.plane()[node] = at(a, field_now(), c);
    saved.v.plane()[node] = at(a, field_v, c);
    if (plan_.keeps_force) saved.force.plane()[node] = at(a, field_force, c);
    if (plan_.wheel) saved.u_before.plane()[node] = at(a, field_next(), c);
  });
}

void CyclicChunk::save_displacement(bool candidates, std::span<Vec2> u) const noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) { u[node] = turn(c) * at(a, field_now(), c); },
                candidates);
}

void CyclicChunk::save_velocity(std::span<Vec2> v) const noexcept {
  if (!plan_.wheel)
    return for_own_nodes(
        [&](int a, int c, std::size_t node) { v[node] = turn(c) * at(a, field_v, c); });
  for_own_nodes([&](int a, int c, std::size_t node) {
    v[node] = turn(c) * (at(a, field_now(), c) - at(a, field_next(), c)) / model_.dt;
  });
}

std::array<int, 3> CyclicChunk::edge_fields() const noexcept {
  return {field_now(), field_v, field_force};
}

/// With a wide halo, step i of k leaves k - 1 - i columns of it right on each side.
CyclicChunk::Extent CyclicChunk::extent(std::size_t step, std::size_t n_steps) const noexcept {
  const int own = (range_.columns + kernels::lanes - 1) / kernels::lanes;
  const int beyond = static_cast<int>(n_steps - 1 - step);
  if (plan_.halo != Halo::wide || beyond == 0) return {0, own, 0, range_.columns};
  const int last = (range_.columns + beyond + kernels::lanes - 1) / kernels::lanes;
  return {-1, last, -beyond, range_.columns + beyond};
}

class CyclicChunk::InPass final : public CandidateFields {
 public:
  InPass(CyclicChunk& chunk, const Work& work) : chunk_(chunk), work_(work) {}

  [[nodiscard]] CandidateMotion motion_of(std::size_t candidate) const noexcept override {
    return chunk_.motion_of(chunk_.plan_.place[candidate], work_.now);
  }
  void move(std::size_t candidate, Vec2 v, Vec2 u) noexcept override {
    chunk_.set_motion(chunk_.plan_.place[candidate], work_.next, v, u);
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
  s.now = field(0, now);
  s.next = field(0, next);
  s.velocity = field(0, field_v);
  s.force = field(0, field_force);
  s.stride = plan_.stride;
  s.turn_x = turn_x_.data() + halo_columns;
  s.turn_y = turn_y_.data() + halo_columns;
  s.columns = range_.columns;
  return s;
}

void CyclicChunk::strip(const Work& work, int i) noexcept {
  const int first = i * kernels::most_rows;
  const int n = std::min(kernels::most_rows, plan_.n_local - first);
  InPass fields(*this, work);
  if (work.corners && i == plan_.first_contact_strip) work.corners->find(*work.step, fields);
  touching_.clear();
  if (work.step->contact && !has_massless_contact(model_))
    for (int a = first; a < first + n; ++a)
      if (plan_.contact_row[static_cast<std::size_t>(a)] >= 0) find_touching(work, a);
  kernels::CyclicStrip s = strip_from(first, work.now, work.next);
  s.first_pack = work.extent.first_pack;
  s.last_pack = work.extent.last_pack;
  s.keep_tail = plan_.halo != Halo::wide;
  s.lowest = first == 0;
  s.highest = first + n == plan_.n_local;
  s.step = &work.step->factors;
  s.wheel = &work.step->wheel;
  s.sums = sums_.data() +
           work.place * range_.n_groups * static_cast<std::size_t>(plan_.n_sums() * kernels::lanes);
  const std::size_t load = plan_.first_load(i);
  const bool loaded = load < plan_.first_load(i + 1);
  s.loads = loaded ? loads_.data() + CyclicPlan::lead +
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
  if (plan_.halo == Halo::ring && !plan_.wheel)
    for (int a = first; a < first + n; ++a) wrap(layout(), a, work.next);
  if (work.corners && i == plan_.last_contact_strip)
    work.corners->solve(*work.step, fields, *work.held);
}

void CyclicChunk::pass(std::span<const StepContext> steps, PartialStep* parts, std::size_t stride,
                       CornerContact* corners) noexcept {
  RONDO_ASSERT(!steps.empty() && steps.size() <= static_cast<std::size_t>(plan_.depth),
               steps.size(), plan_.depth);
  std::fill_n(sums_.data(), sums_.size(), 0.0);
  std::fill(contact_.begin(), contact_.end(), PartialStep{});
  active_.clear();
  const std::size_t n = steps.size();
  std::array<Work, most_steps_in_a_pass> work;
  for (std::size_t i = 0; i < n; ++i) {
    const bool even = (steps_ + static_cast<long long>(i)) % 2 == 0;
    work[i] = {&steps[i],
               extent(i, n),
               i,
               even ? field_u_even : field_u_odd,
               even ? field_u_odd : field_u_even,
               i + 1 == n,
               corners,
               parts + (i + 1) * stride - 1};
  }
  std::array<int, most_steps_in_a_pass> done{};  // strips done by each step
  const int n_strips = plan_.n_strips();
  while (done[n - 1] < n_strips) {
    if (done[0] < n_strips) strip(work[0], done[0]++);
    // The others follow as far as they can.
    for (std::size_t i = 1; i < n; ++i)
      while (done[i] < n_strips && plan_.needs[static_cast<std::size_t>(done[i])] < done[i - 1])
        strip(work[i], done[i]++);
  }
  if (!plan_.wheel) steps_ += static_cast<long long>(n);
  ++passes_;
  hand_over(n, parts, stride);
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

namespace {

double sum_in_order(const double* x) noexcept {
  double sum = 0.0;
  for (int lane = 0; lane < kernels::lanes; ++lane) sum += x[lane];
  return sum;
}
/// So that few sums wait for others: a loaded rim has many.
double sum_in_pairs(const double* x) noexcept {
  static_assert(kernels::lanes == 8);
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

}  // namespace

void CyclicChunk::hand_over(std::size_t n_steps, PartialStep* parts,
                            std::size_t stride) const noexcept {
  for (std::size_t i = 0; i < n_steps; ++i)
    for (std::size_t g = 0; g < range_.n_groups; ++g) {
      const std::size_t place = i * range_.n_groups + g;
      PartialStep& part = parts[i * stride + range_.first_group + g];
      part = contact_.empty() ? PartialStep{} : contact_[place];
      const auto n_sums = static_cast<std::size_t>(plan_.n_sums());
      const double* sums = sums_.data() + place * n_sums * kernels::lanes;
      for (std::size_t k = 0; k < n_sums; ++k, sums += kernels::lanes)
        part.sums[k] += plan_.wheel ? sum_in_pairs(sums) : sum_in_order(sums);
    }
}

}  // namespace rondo::dynamics
