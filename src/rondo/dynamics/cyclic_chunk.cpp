// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/cyclic_chunk.hpp"

#include <algorithm>

namespace rondo::dynamics {
namespace {

constexpr int group_columns = kernels::group_packs * kernels::lanes;
enum Field { field_u = 0, field_v = 2, field_force = 4 };

}  // namespace

CyclicChunk::CyclicChunk(const Model& model, const CyclicPlan& plan, const kernels::Table& table,
                         const CyclicChunkRange& range)
    : model_(model),
      plan_(plan),
      table_(table),
      range_(range),
      fields_(plan.chunk_size()),
      sums_(static_cast<std::size_t>(plan.depth * kernels::n_sums * kernels::lanes) *
            range.n_groups),
      contact_(model.contact ? static_cast<std::size_t>(plan.depth) * range.n_groups : 0) {
  const int n = plan.n_sectors;
  const auto columns = static_cast<int>(plan.stride) - 2 * halo_columns;
  for (int c = -halo_columns; c < columns + halo_columns; ++c) {
    const int sector = ((range.first + c) % n + n) % n;
    turn_x_.push_back(model.sector->turn[static_cast<std::size_t>(sector)].x);
    turn_y_.push_back(model.sector->turn[static_cast<std::size_t>(sector)].y);
  }
  if (plan.halo != Halo::ring)
    for (auto& parity : edges_)
      for (LargeArray& edge : parity)
        edge = LargeArray(static_cast<std::size_t>(plan.n_local * edge_fields() * edge_width()));
  if (!model.contact) return;
  const auto most = static_cast<std::size_t>(range.columns + 2 * halo_columns);
  low_.resize(most + kernels::lanes);
  touching_.reserve(most);
  active_.reserve(2 * most * plan.candidate.size());
}

Vec2 CyclicChunk::at(int row, int field, int column) const noexcept {
  const double* x = fields_.data() + plan_.row_at(row) + field * plan_.stride + column;
  return {x[0], x[plan_.stride]};
}

void CyclicChunk::load(const State& state) {
  const fem::SectorStiffness& k = *model_.sector;
  for (int a = 0; a < plan_.n_local; ++a)
    for (int c = 0; c < range_.columns; ++c) {
      const std::size_t node =
          k.node(static_cast<std::size_t>(a), static_cast<std::size_t>(range_.first + c));
      const Vec2 to_sector = conj(turn(c));
      const auto put = [&](int field, Vec2 value) {
        double* x = fields_.data() + plan_.row_at(a) + field * plan_.stride + c;
        x[0] = value.x;
        x[plan_.stride] = value.y;
      };
      const Vec2 v = to_sector * state.v_next[node];
      put(field_u, to_sector * state.u[node] + model_.dt * v);
      put(field_v, v);
      if (plan_.n_fields > field_force) put(field_force, to_sector * state.force[node]);
    }
  if (plan_.halo == Halo::ring)
    for (int a = 0; a < plan_.n_local; ++a) wrap(a);
}

void CyclicChunk::save_field(int field, std::vector<Vec2>& out) const noexcept {
  const fem::SectorStiffness& k = *model_.sector;
  for (int c = 0; c < range_.columns; ++c)
    for (int a = 0; a < plan_.n_local; ++a)
      out[k.node(static_cast<std::size_t>(a), static_cast<std::size_t>(range_.first + c))] =
          turn(c) * at(a, field, c);
}

void CyclicChunk::save_displacement(std::vector<Vec2>& u) const noexcept {
  save_field(field_u, u);
}

void CyclicChunk::save_velocity(std::vector<Vec2>& v) const noexcept {
  save_field(field_v, v);
}

void CyclicChunk::wrap(int a) noexcept {
  for (int component = 0; component < 2; ++component) {
    double* u = fields_.data() + plan_.row_at(a) + component * plan_.stride;
    u[-1] = u[range_.columns - 1];
    u[range_.columns] = u[0];
  }
}

void CyclicChunk::give_edges(unsigned pass) noexcept {
  const int width = edge_width();
  double* left = edges_[pass % 2][0].data();
  double* right = edges_[pass % 2][1].data();
  for (int a = 0; a < plan_.n_local; ++a)
    for (int field = 0; field < edge_fields(); ++field) {
      const double* x = fields_.data() + plan_.row_at(a) + field * plan_.stride;
      left = std::copy_n(x, width, left);
      right = std::copy_n(x + range_.columns - width, width, right);
    }
}

void CyclicChunk::take_halo(const CyclicChunk& left, const CyclicChunk& right,
                            unsigned pass) noexcept {
  const int width = edge_width();
  const double* from_left = left.edges_[pass % 2][1].data();
  const double* from_right = right.edges_[pass % 2][0].data();
  for (int a = 0; a < plan_.n_local; ++a)
    for (int field = 0; field < edge_fields(); ++field) {
      double* x = fields_.data() + plan_.row_at(a) + field * plan_.stride;
      std::copy_n(from_left, width, x - width);
      std::copy_n(from_right, width, x + range_.columns);
      from_left += width;
      from_right += width;
    }
}

/// With a wide halo, step i of k leaves k - 1 - i columns of it right on each side.
CyclicChunk::Extent CyclicChunk::extent(std::size_t step, std::size_t n_steps) const noexcept {
  const int own = (range_.columns + kernels::lanes - 1) / kernels::lanes;
  const int beyond = static_cast<int>(n_steps - 1 - step);
  if (plan_.halo != Halo::wide || beyond == 0) return {0, own, 0, range_.columns};
  const int last = (range_.columns + beyond + kernels::lanes - 1) / kernels::lanes;
  return {-1, last, -beyond, range_.columns + beyond};
}

void CyclicChunk::find_touching(const StepContext& step, const Extent& extent, int a) noexcept {
  touching_.clear();
  const CyclicRowData& data = plan_.rows[static_cast<std::size_t>(a)];
  const ContactStep& contact = *step.contact;
  const contact::Ground& ground = model_.contact->ground;
  constexpr double margin = 1e-9;  // m: the nodes found are looked at again, exactly
  const int n = table_.low_columns({.u = fields_.data() + plan_.row_at(a),
                                    .stride = plan_.stride,
                                    .x = data.reference.x,
                                    .y = data.reference.y,
                                    .turn_x = turn_x_.data() + halo_columns,
                                    .turn_y = turn_y_.data() + halo_columns,
                                    .rotation_x = contact.rotation.x,
                                    .rotation_y = contact.rotation.y,
                                    .limit = ground.top() - contact.center.y + margin,
                                    .first = extent.first_column,
                                    .last = extent.last_column},
                                   low_.data());
  for (int i = 0; i < n; ++i) {
    const int c = low_[static_cast<std::size_t>(i)];
    const Vec2 arm = turn(c) * (data.reference + at(a, field_u, c));
    const contact::Touches touches = ground.touches(contact.center + contact.rotation * arm);
    if (touches.count == 0) continue;
    touching_.push_back({c, touches, at(a, field_v, c),
                         plan_.n_fields > field_force ? at(a, field_force, c) : Vec2{}});
  }
}

void CyclicChunk::solve_touching(const StepContext& step, std::size_t place, int a) noexcept {
  const CyclicRowData& data = plan_.rows[static_cast<std::size_t>(a)];
  const std::vector<int>& candidate = plan_.candidate[static_cast<std::size_t>(data.contact_row)];
  for (const Touching& t : touching_) {
    const Vec2 frame = turn(t.column);
    const int sector = (range_.first + t.column + plan_.n_sectors) % plan_.n_sectors;
    const auto k = static_cast<std::size_t>(candidate[static_cast<std::size_t>(sector)]);
    const ContactNode node{k,
                           data.mass,
                           model_.contact->tributary[k],
                           frame * (data.reference + at(a, field_u, t.column)),
                           frame * t.v,
                           frame * at(a, field_v, t.column)};
    std::array<ActiveContact, 2> contacts;
    const std::span active(contacts.data(), static_cast<std::size_t>(t.touches.count));
    ContactReport report;
    const Vec2 after = solve_contacts(*step.contact, node, t.touches, active, report);
    double* v = fields_.data() + plan_.row_at(a) + field_v * plan_.stride + t.column;
    const Vec2 turned = conj(frame) * after;
    v[0] = turned.x;
    v[plan_.stride] = turned.y;
    if (t.column < 0 || t.column >= range_.columns) continue;  // a neighbour's, who reports it
    PartialStep& part =
        contact_[place * range_.n_groups + static_cast<std::size_t>(t.column / group_columns)];
    part.contact.add(report);
    const Vec2 change =
        plan_.n_fields > field_force ? frame * (at(a, field_force, t.column) - t.force) : Vec2{};
    correct_sums(step, node, after, change, part.sums);
    if (keep_active_) active_.insert(active_.end(), active.begin(), active.end());
  }
}

void CyclicChunk::row(const StepContext& step, const Extent& extent, std::size_t place,
                      int a) noexcept {
  const auto i = static_cast<std::size_t>(a);
  const CyclicRowData& data = plan_.rows[i];
  const bool candidates = step.contact && data.contact_row >= 0;
  if (candidates) find_touching(step, extent, a);
  kernels::CyclicRow r;
  r.base = fields_.data();
  r.at = plan_.row_at(a);
  r.stride = plan_.stride;
  r.entries = plan_.entries.data() + plan_.entry_start[i];
  r.n_entries = plan_.entry_start[i + 1] - plan_.entry_start[i];
  r.mass = data.mass;
  r.dt_over_mass = step.factors.dt / data.mass;
  r.x = data.reference.x;
  r.y = data.reference.y;
  r.turn_x = turn_x_.data() + halo_columns;
  r.turn_y = turn_y_.data() + halo_columns;
  r.first_pack = extent.first_pack;
  r.last_pack = extent.last_pack;
  r.columns = range_.columns;
  r.keep_tail = plan_.halo != Halo::wide;
  r.step = &step.factors;
  r.sums = sums_.data() + place * range_.n_groups * kernels::n_sums * kernels::lanes;
  const kernels::Terms& terms = step.terms;
  table_.cyclic_row[terms.stiffness_damping][terms.printed][terms.pull](r);
  if (candidates && !touching_.empty()) solve_touching(step, place, a);
  for (int j = plan_.advanced_start[i]; j < plan_.advanced_start[i + 1]; ++j) {
    const int b = plan_.advanced[static_cast<std::size_t>(j)];
    table_.advance_row(fields_.data() + plan_.row_at(b), plan_.stride, step.factors.dt,
                       extent.first_pack, extent.last_pack);
    if (plan_.halo == Halo::ring) wrap(b);
  }
}

void CyclicChunk::pass(std::span<const StepContext> steps, PartialStep* parts,
                       std::size_t stride) noexcept {
  std::fill_n(sums_.data(), sums_.size(), 0.0);
  std::fill(contact_.begin(), contact_.end(), PartialStep{});
  active_.clear();
  std::array<int, most_steps_in_a_pass> done{};  // rows done by each step
  const std::size_t n = steps.size();
  while (done[n - 1] < plan_.n_local)
    for (std::size_t i = 0; i < n; ++i) {
      const auto ready = [&] {
        return done[i] < plan_.n_local &&
               (i == 0 || plan_.needs[static_cast<std::size_t>(done[i])] < done[i - 1]);
      };
      keep_active_ = i + 1 == n;
      const Extent columns = extent(i, n);
      // The first step leads by one row at a time, the others follow as far as they can.
      for (bool go = ready(); go; go = i > 0 && ready()) row(steps[i], columns, i, done[i]++);
    }
  hand_over(n, parts, stride);
}

void CyclicChunk::hand_over(std::size_t n_steps, PartialStep* parts, std::size_t stride) noexcept {
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
