// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/cyclic_chunk.hpp"

#include <algorithm>

namespace rondo::dynamics {
namespace {

constexpr int group_columns = kernels::group_packs * kernels::lanes;
enum Field { field_u_even = 0, field_u_odd = 2, field_v = 4, field_force = 6 };

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
      sums_(static_cast<std::size_t>(plan.depth * kernels::n_sums * kernels::lanes) *
            range.n_groups),
      contact_(model.contact ? static_cast<std::size_t>(plan.depth) * range.n_groups : 0) {
  const int n = plan.n_sectors;
  const auto columns = static_cast<int>(plan.stride) - 2 * halo_columns;
  for (int c = -halo_columns; c < columns + halo_columns; ++c) {
    const int sector = ((range.first + c) % n + n) % n;
    turn_x_.push_back(model.sector->turn[static_cast<std::size_t>(sector)].re);
    turn_y_.push_back(model.sector->turn[static_cast<std::size_t>(sector)].im);
  }
  fill_loads();
  if (plan.halo != Halo::ring)
    for (auto& parity : edges_)
      for (LargeArray& edge : parity)
        edge =
            LargeArray(static_cast<std::size_t>(plan.n_local * edge_width() * 2) * n_edge_fields());
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

/// K u_0 by the very blocks of the steps: with others, alike to round-off, the ledger would begin
/// with their difference.
Vec2 CyclicChunk::initial_force(const std::vector<Vec2>& u, int a, int c) const noexcept {
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
void CyclicChunk::for_own_nodes(Visit&& visit) const noexcept {
  for (int a = 0; a < plan_.n_local; ++a)
    for (int c = 0; c < range_.columns; ++c)
      visit(a, c,
            model_.sector->node(static_cast<std::size_t>(a),
                                static_cast<std::size_t>(std::ptrdiff_t{range_.first} + c)));
}

void CyclicChunk::load(const State& state) {
  for_own_nodes([&](int a, int c, std::size_t node) {
    const Complex to_sector = conj(turn(c));
    const Vec2 v = to_sector * state.v_next[node];
    put(a, field_now(), c, to_sector * state.u[node] + model_.dt * v);
    put(a, field_v, c, v);
    if (plan_.keeps_force) put(a, field_force, c, initial_force(state.u, a, c));
  });
  show_to_others();
}

void CyclicChunk::restore(const SavedState& saved) noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) {
    put(a, field_now(), c, saved.u[node]);
    put(a, field_v, c, saved.v[node]);
    if (plan_.keeps_force) put(a, field_force, c, saved.force[node]);
  });
  show_to_others();
}

/// What is right of the chunk's own nodes, where it is read for the next pass.
void CyclicChunk::show_to_others() noexcept {
  if (plan_.halo != Halo::ring) return give_edges();
  for (int a = 0; a < plan_.n_local; ++a) wrap(a, field_now());
}

void CyclicChunk::save(SavedState& saved) const noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) {
    saved.u[node] = at(a, field_now(), c);
    saved.v[node] = at(a, field_v, c);
    if (plan_.keeps_force) saved.force[node] = at(a, field_force, c);
  });
}

void CyclicChunk::save_field(int field, std::vector<Vec2>& out) const noexcept {
  for_own_nodes([&](int a, int c, std::size_t node) { out[node] = turn(c) * at(a, field, c); });
}

void CyclicChunk::save_displacement(std::vector<Vec2>& u) const noexcept {
  save_field(field_now(), u);
}

void CyclicChunk::save_velocity(std::vector<Vec2>& v) const noexcept {
  save_field(field_v, v);
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

/// Place in ContactModel::nodes of a node of a contact row.
std::size_t CyclicChunk::candidate_at(int row, int column) const noexcept {
  const auto contact_row =
      static_cast<std::size_t>(plan_.contact_row[static_cast<std::size_t>(row)]);
  const int sector = (range_.first + column + plan_.n_sectors) % plan_.n_sectors;
  return static_cast<std::size_t>(plan_.candidate[contact_row][static_cast<std::size_t>(sector)]);
}

CandidateMotion CyclicChunk::motion_of(CyclicPlace place, int field_u) const noexcept {
  const int c = place.sector - range_.first;
  const Complex frame = turn(c);
  return {frame * at(place.row, field_u, c), frame * at(place.row, field_v, c),
          plan_.keeps_force ? frame * at(place.row, field_force, c) : Vec2{}};
}

void CyclicChunk::set_motion(CyclicPlace place, int field_u, Vec2 v, Vec2 u) noexcept {
  const int c = place.sector - range_.first;
  put(place.row, field_v, c, conj(turn(c)) * v);
  put(place.row, field_u, c, conj(turn(c)) * u);
  if (plan_.halo == Halo::ring) wrap(place.row, field_u);
}

CandidateMotion CyclicChunk::motion_of(CyclicPlace place) const noexcept {
  return motion_of(place, field_now());
}

void CyclicChunk::move(CyclicPlace place, Vec2 v, Vec2 u) noexcept {
  set_motion(place, field_now(), v, u);
  if (plan_.halo != Halo::ring) give_edges();
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

void CyclicChunk::find_touching(const Work& work, int a) noexcept {
  const kernels::CyclicRow& row = plan_.rows[static_cast<std::size_t>(a)];
  const ContactStep& contact = *work.step->contact;
  const contact::Ground& ground = model_.contact->ground;
  constexpr double margin = 1e-9;  // m: the nodes found are looked at again, exactly
  const int n = table_.low_columns({.u = field(a, work.now),
                                    .stride = plan_.stride,
                                    .x = row.x,
                                    .y = row.y,
                                    .turn_x = turn_x_.data() + halo_columns,
                                    .turn_y = turn_y_.data() + halo_columns,
                                    .rotation_x = contact.rotation.re,
                                    .rotation_y = contact.rotation.im,
                                    .limit = ground.top() - contact.center.y + margin,
                                    .first = work.extent.first_column,
                                    .last = work.extent.last_column},
                                   low_.data());
  for (int i = 0; i < n; ++i) {
    const int c = low_[static_cast<std::size_t>(i)];
    const Vec2 arm = turn(c) * (Vec2{row.x, row.y} + at(a, work.now, c));
    const contact::Touches touches = ground.touches(contact.center + contact.rotation * arm);
    if (touches.count == 0) continue;
    if (work.step->held && work.step->held[candidate_at(a, c)]) continue;
    touching_.push_back(
        {a, c, touches, at(a, field_v, c), plan_.keeps_force ? at(a, field_force, c) : Vec2{}});
  }
}

void CyclicChunk::solve_node(const Work& work, const Touching& t) noexcept {
  const kernels::CyclicRow& row = plan_.rows[static_cast<std::size_t>(t.row)];
  const std::size_t k = candidate_at(t.row, t.column);
  const Complex frame = turn(t.column);
  const Vec2 u = at(t.row, work.now, t.column);
  const ContactNode node{k,
                         row.mass,
                         model_.contact->tributary[k],
                         frame * (Vec2{row.x, row.y} + u),
                         frame * t.v,
                         frame * at(t.row, field_v, t.column)};
  std::array<ActiveContact, 2> contacts;
  const std::span active(contacts.data(), static_cast<std::size_t>(t.touches.count));
  ContactReport report;
  const Vec2 after = solve_contacts(*work.step->contact, node, t.touches, active, report);
  const Vec2 v = conj(frame) * after;
  put(t.row, field_v, t.column, v);
  put(t.row, work.next, t.column, u + model_.dt * v);
  if (t.column < 0 || t.column >= range_.columns) return;  // a neighbour's, who reports it
  PartialStep& part =
      contact_[work.place * range_.n_groups + static_cast<std::size_t>(t.column / group_columns)];
  part.contact.add(report);
  const Vec2 change =
      plan_.keeps_force ? frame * (at(t.row, field_force, t.column) - t.force) : Vec2{};
  correct_sums(*work.step, node, after, {change, frame * load_on(work, t.row, t.column)},
               part.sums);
  if (work.last) active_.insert(active_.end(), active.begin(), active.end());
}

void CyclicChunk::strip(const Work& work, int i) noexcept {
  const int first = i * kernels::most_rows;
  const int n = std::min(kernels::most_rows, plan_.n_local - first);
  InPass fields(*this, work);
  if (work.corners && i == plan_.first_contact_strip) work.corners->find(*work.step, fields);
  touching_.clear();
  if (work.step->contact)
    for (int a = first; a < first + n; ++a)
      if (plan_.contact_row[static_cast<std::size_t>(a)] >= 0) find_touching(work, a);
  kernels::CyclicStrip s;
  s.rows = plan_.rows.data() + first;
  s.n_rows = n;
  s.mirror = plan_.mirror.empty() ? nullptr : plan_.mirror.data() + first;
  s.row_size = plan_.row_size();
  s.now = field(0, work.now);
  s.next = field(0, work.next);
  s.velocity = field(0, field_v);
  s.force = field(0, field_force);
  s.stride = plan_.stride;
  s.turn_x = turn_x_.data() + halo_columns;
  s.turn_y = turn_y_.data() + halo_columns;
  s.first_pack = work.extent.first_pack;
  s.last_pack = work.extent.last_pack;
  s.columns = range_.columns;
  s.keep_tail = plan_.halo != Halo::wide;
  s.lowest = first == 0;
  s.highest = first + n == plan_.n_local;
  s.step = &work.step->factors;
  s.sums = sums_.data() + work.place * range_.n_groups * kernels::n_sums * kernels::lanes;
  const std::size_t load = plan_.first_load(i);
  const bool loaded = load < plan_.first_load(i + 1);
  s.loads = loaded ? loads_.data() + CyclicPlan::lead +
                         2 * static_cast<std::ptrdiff_t>(load) * plan_.stride
                   : nullptr;
  s.load_of = plan_.load_of.data() + load;
  s.pressures = work.step->pressures;
  const kernels::Terms& terms = work.step->terms;
  table_.cyclic_strip[loaded][terms.stiffness_damping][terms.unsteady](s);
  for (const Touching& t : touching_) solve_node(work, t);
  if (plan_.halo == Halo::ring)
    for (int a = first; a < first + n; ++a) wrap(a, work.next);
  if (work.corners && i == plan_.last_contact_strip)
    work.corners->solve(*work.step, fields, *work.held);
}

void CyclicChunk::pass(std::span<const StepContext> steps, PartialStep* parts, std::size_t stride,
                       CornerContact* corners) noexcept {
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
  steps_ += static_cast<long long>(n);
  ++passes_;
  hand_over(n, parts, stride);
}

void CyclicChunk::hand_over(std::size_t n_steps, PartialStep* parts,
                            std::size_t stride) const noexcept {
  for (std::size_t i = 0; i < n_steps; ++i)
    for (std::size_t g = 0; g < range_.n_groups; ++g) {
      const std::size_t place = i * range_.n_groups + g;
      PartialStep& part = parts[i * stride + range_.first_group + g];
      part = contact_.empty() ? PartialStep{} : contact_[place];
      const double* sums = sums_.data() + place * kernels::n_sums * kernels::lanes;
      for (double& sum : part.sums) {
        double lanes = 0.0;
        for (int lane = 0; lane < kernels::lanes; ++lane) lanes += *sums++;
        sum += lanes;
      }
    }
}

}  // namespace rondo::dynamics
