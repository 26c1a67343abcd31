// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/sparse_integrator.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/fused/tail/implicit_tail.hpp"
#include "rondo/integrators/fused/tail/massless_tail.hpp"
#include "rondo/model/friction_work.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;
constexpr std::size_t force_at = 2 * lanes;  ///< K u of a row, from its v

Vec2 pair_at(const double* u, int row) noexcept {
  return {u[2 * row], u[2 * row + 1]};
}
/// A vector of a pack, its components in two lines of lanes.
Vec2 vector_at(const double* x) noexcept {
  return {x[0], x[lanes]};
}
void put(double* x, Vec2 value) noexcept {
  x[0] = value.x;
  x[lanes] = value.y;
}

std::size_t n_sums_of(bool wheel, bool rubber) noexcept {
  if (wheel && rubber) return kernels::n_rubber_wheel_sums;
  if (wheel) return kernels::n_wheel_sums;
  if (rubber) return kernels::n_rubber_sums;
  return kernels::n_sums;
}

}  // namespace

/// Some nodes, wherever their rows are.
class SparseIntegrator::Rows final : public NodeFields {
 public:
  Rows(SparseIntegrator& of, const NodeSet& nodes) : of_(of) {
    std::vector<std::size_t> row(of.model_.n_nodes());
    for (std::size_t i = 0; i < of.plan_.node.size(); ++i) row[at(of.plan_.node[i])] = i;
    RONDO_ASSERT(std::ranges::all_of(nodes.node,
                                     [&](int node) {
                                       const std::size_t i = row[at(node)];
                                       return of.plan_.node[i] == node;
                                     }),
                 nodes.size());  // none is clamped
    for (const int node : nodes.node) rows_.push_back(row[at(node)]);
  }

  void read_displacement(PlaneField& u) const noexcept override {
    const double* now = of_.u_[parity(of_.step_)].data();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      u.put(i, pair_at(now, static_cast<int>(rows_[i])));
  }
  void read_velocity(PlaneField& v) const noexcept override {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      v.put(i, vector_at(of_.motion_.data() + of_.motion_at(rows_[i])));
  }
  void read_force(PlaneField& force) const noexcept override {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      force.put(i, vector_at(of_.motion_.data() + of_.motion_at(rows_[i]) + force_at));
  }
  void write(const PlaneField& u, const PlaneField& v) noexcept override {
    RONDO_ASSERT(u.size() == rows_.size() && v.size() == rows_.size(), u.size(), v.size());
    double* now = of_.u_[parity(of_.step_)].data();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      now[2 * rows_[i]] = u.x[i];
      now[2 * rows_[i] + 1] = u.y[i];
      put(of_.motion_.data() + of_.motion_at(rows_[i]), v.at(i));
    }
  }

 private:
  SparseIntegrator& of_;
  std::vector<std::size_t> rows_;
};

SparseIntegrator::~SparseIntegrator() = default;

SparseIntegrator::SparseIntegrator(const Model& model, const State& start,
                                   const kernels::Table& table)
    : SparseIntegrator(model, start, table, make_sparse_plan(model)) {}

SparseIntegrator::SparseIntegrator(const Model& model, const State& start,
                                   const kernels::Table& table, SparsePlan plan)
    : BatchIntegrator(model, start, plan.n_blocks, plan.n_blocks),
      table_(table),
      plan_(std::move(plan)),
      u_{LargeArray(plan_.n_packs * 2 * lanes), LargeArray(plan_.n_packs * 2 * lanes)},
      motion_(plan_.n_packs * plan_.motion_size()),
      contacts_(static_cast<std::size_t>(model.threads)),
      kept_(model.contact && has_friction_law(model) ? model.contact->nodes.size() : 0) {
  for (Contacts& contacts : contacts_) {
    contacts.touching.reserve(plan_.candidates.size());
    contacts.active.reserve(2 * plan_.candidates.size());
  }
  load(start);
  add_tails(table);
  if (!model.rubber) return;
  RONDO_DEMAND(plan_.node.size() < plan_.n_packs * lanes && table.rubber, plan_.node.size(),
               plan_.n_packs);  // clamped corners read the row of zeros behind the last
  rubber_.emplace(model, plan_.row_of_node, static_cast<int>(plan_.node.size()), plan_.n_packs,
                  start.u, *table.rubber);
  set_rubber(*rubber_, start);
  if (!plan_.first_load.empty()) following_.emplace(model, plan_);
}

/// The nodes, and their rows.
NodesInStep SparseIntegrator::rows_of(std::span<const int> nodes) {
  NodeSet set = node_set(model_, nodes);
  rows_.push_back(std::make_unique<Rows>(*this, set));
  return {std::move(set), rows_.back().get()};
}

/// The ring follows what is around it: implicit elements first.
void SparseIntegrator::add_tails(const kernels::Table& table) {
  if (model_.implicit) {
    NodesInStep rows = rows_of(model_.implicit->nodes);
    auto implicit = assembled_operator(model_, rows.nodes, factored_spin(model_));
    add_tail(implicit_tail(model_, std::move(rows.nodes), std::move(implicit), *rows.fields));
  }
  if (!has_massless_contact(model_)) return;
  add_tail(massless_tail(model_, rows_of(massless_nodes(model_)), rows_of(nodes_around(model_)),
                         table.ring_product));
}

std::size_t SparseIntegrator::motion_at(std::size_t row) const noexcept {
  return row / lanes * plan_.motion_size() + row % lanes;
}

void SparseIntegrator::load(const State& start) {
  double* now = u_[parity(step_)].data();
  for (std::size_t i = 0; i < plan_.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(plan_.node[i]);
    const Vec2 u = start.u.plane()[node] + model_.dt * start.v_next.plane()[node];
    now[2 * i] = u.x;
    now[2 * i + 1] = u.y;
    double* motion = motion_.data() + motion_at(i);
    put(motion, start.v_next.plane()[node]);
    if (plan_.keeps_force) put(motion + force_at, start.force.plane()[node]);
  }
  if (plan_.wheel) load_on_rim(start);
}

/// Sets the velocities that are carried, which are V in the axes of R_n; u_n stays.
void SparseIntegrator::load_on_rim(const State& start) {
  LoadedRim rim(model_);
  rim.restore(start.step, start.rim);
  double* before = u_[parity(step_ + 1)].data();
  for (std::size_t i = 0; i < plan_.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(plan_.node[i]);
    const Vec2 u = start.u.plane()[node];
    before[2 * i] = u.x;
    before[2 * i + 1] = u.y;
    put(motion_.data() + motion_at(i),
        rim.velocity_of(model_.reference[node] + u, model_.dt * start.v_next.plane()[node]));
  }
}

void SparseIntegrator::save_displacement(Nodes of, Field& u) const noexcept {
  const double* now = u_[parity(step_)].data();
  if (of == Nodes::candidates) {
    for (const SparseCandidate& c : plan_.candidates)
      u.plane()[at(plan_.node[static_cast<std::size_t>(c.row)])] = pair_at(now, c.row);
    return;
  }
  for (std::size_t i = 0; i < plan_.node.size(); ++i)
    u.plane()[at(plan_.node[i])] = pair_at(now, static_cast<int>(i));
}

void SparseIntegrator::save_velocity(Field& v) const noexcept {
  const double *now = u_[parity(step_)].data(), *before = u_[parity(step_ + 1)].data();
  if (plan_.wheel) {
    for (std::size_t i = 0; i < plan_.node.size(); ++i) {
      const auto row = static_cast<int>(i);
      v.plane()[at(plan_.node[i])] = (pair_at(now, row) - pair_at(before, row)) / model_.dt;
    }
    return;
  }
  for (std::size_t i = 0; i < plan_.node.size(); ++i)
    v.plane()[at(plan_.node[i])] = vector_at(motion_.data() + motion_at(i));
}

void SparseIntegrator::save_fields(SavedState& saved) const noexcept {
  save_displacement(Nodes::free, saved.u);
  save_velocity(saved.v);
  if (plan_.keeps_force)
    for (std::size_t i = 0; i < plan_.node.size(); ++i)
      saved.force.plane()[at(plan_.node[i])] = vector_at(motion_.data() + motion_at(i) + force_at);
  for (std::size_t k = 0; k < kept_.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i)
      if (kept_[k][i] != 0.0) saved.impulses.emplace_back(2 * k + i, Vec2{kept_[k][i], 0.0});
  if (!plan_.wheel) return;
  const double* before = u_[parity(step_ + 1)].data();
  for (std::size_t i = 0; i < plan_.node.size(); ++i) {
    saved.v.plane()[at(plan_.node[i])] = vector_at(motion_.data() + motion_at(i));
    saved.u_before.plane()[at(plan_.node[i])] = pair_at(before, static_cast<int>(i));
  }
}

void SparseIntegrator::restore_fields(const SavedState& saved) noexcept {
  std::ranges::fill(kept_, std::array<double, 2>{});
  for (const auto& [key, impulse] : saved.impulses)
    if (!kept_.empty()) kept_[key / 2][key % 2] = impulse.x;
  double* now = u_[parity(step_)].data();
  for (std::size_t i = 0; i < plan_.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(plan_.node[i]);
    now[2 * i] = saved.u.plane()[node].x;
    now[2 * i + 1] = saved.u.plane()[node].y;
    double* motion = motion_.data() + motion_at(i);
    put(motion, saved.v.plane()[node]);
    if (plan_.keeps_force) put(motion + force_at, saved.force.plane()[node]);
    if (!plan_.wheel) continue;
    double* before = u_[parity(step_ + 1)].data() + 2 * i;
    before[0] = saved.u_before.plane()[node].x;
    before[1] = saved.u_before.plane()[node].y;
  }
}

void SparseIntegrator::save_active(std::vector<ActiveContact>& active) const noexcept {
  for (const Contacts& contacts : contacts_)
    active.insert(active.end(), contacts.active.begin(), contacts.active.end());
}

CandidateMotion SparseIntegrator::motion_of(std::size_t candidate) const noexcept {
  RONDO_ASSERT(candidate < plan_.row.size(), candidate, plan_.row.size());
  const int row = plan_.row[candidate];
  const double* motion = motion_.data() + motion_at(static_cast<std::size_t>(row));
  const double *now = u_[parity(step_)].data(), *before = u_[parity(step_ + 1)].data();
  const Vec2 u = pair_at(now, row);
  return {u, vector_at(motion), plan_.keeps_force ? vector_at(motion + force_at) : Vec2{},
          plan_.wheel ? u - pair_at(before, row) : Vec2{},
          rubber_ && !plan_.wheel ? force_on(before, row) : Vec2{}};
}

void SparseIntegrator::move(std::size_t candidate, Vec3 v, Vec3 u) noexcept {
  const auto row = static_cast<std::size_t>(plan_.row[candidate]);
  put(motion_.data() + motion_at(row), v.plane());
  if (plan_.wheel) return;
  double* now = u_[parity(step_)].data();
  now[2 * row] = u.x;
  now[2 * row + 1] = u.y;
}

void SparseIntegrator::find_touching(const Work& work, std::size_t block) const noexcept {
  work.contacts->touching.clear();
  const ContactStep& contact = *work.step->contact;
  constexpr double margin = 1e-9;  // m: the nodes found are looked at again, exactly
  const double limit = model_.contact->ground.top() - contact.center.y + margin;
  const Vec2 up = {contact.rotation.im, contact.rotation.re};
  const double* u = work.now;
  const SparseCandidate* candidates = plan_.candidates.data();
  const std::size_t last = plan_.first_candidate[block + 1];
  for (std::size_t i = plan_.first_candidate[block]; i < last; ++i) {
    const SparseCandidate& c = candidates[i];
    if (dot(up, c.reference + pair_at(u, c.row)) <= limit) look_at(work, c);
  }
}

/// The block has no contact in a step but those that solve_node() keeps.
void SparseIntegrator::forget_impulses(std::size_t block) noexcept {
  const std::size_t last = plan_.first_candidate[block + 1];
  for (std::size_t i = plan_.first_candidate[block]; i < last; ++i)
    kept_[at(plan_.candidates[i].candidate)] = {};
}

void SparseIntegrator::look_at(const Work& work, const SparseCandidate& c) const noexcept {
  const ContactStep& contact = *work.step->contact;
  const Vec2 u = pair_at(work.now, c.row);
  const contact::Touches touches =
      model_.contact->ground.touches(contact.center + contact.rotation * (c.reference + u));
  if (touches.count == 0) return;
  if (work.step->held && work.step->held[c.candidate]) return;
  const double* motion = motion_.data() + motion_at(static_cast<std::size_t>(c.row));
  work.contacts->touching.push_back(
      {c, touches, u, vector_at(motion), plan_.keeps_force ? vector_at(motion + force_at) : Vec2{},
       kept_.empty() ? std::array<double, 2>{} : kept_[at(c.candidate)]});
}

void SparseIntegrator::solve_node(const Work& work, const Touching& t, PartialStep& part) noexcept {
  const SparseCandidate& c = t.candidate;
  const auto k = static_cast<std::size_t>(c.candidate);
  double* motion = motion_.data() + motion_at(static_cast<std::size_t>(c.row));
  const Complex back{work.step->wheel.back_x, work.step->wheel.back_y};
  const ContactNode node{k,
                         model_.mass[at(model_.contact->nodes[k])],
                         model_.contact->tributary[k],
                         c.reference + t.u,
                         plan_.wheel ? t.v + back * t.v : t.v,
                         vector_at(motion),
                         {pressure_of(t.kept[0], model_.contact->tributary[k], model_.dt),
                          pressure_of(t.kept[1], model_.contact->tributary[k], model_.dt)}};
  std::array<ActiveContact, 2> contacts;
  const std::span active(contacts.data(), static_cast<std::size_t>(t.touches.count));
  const Vec2 after = solve_contacts(*work.step->contact, node, t.touches, active, part.contact);
  put(motion, after);
  for (std::size_t i = 0; !kept_.empty() && i < active.size(); ++i)
    kept_[k][i] = active[i].impulse.x;
  NodeForces forces{.load = load_on(work, c.row)};
  if (rubber_) forces.internal = force_on(work.now, c.row);
  if (plan_.keeps_force) forces.change = vector_at(motion + force_at) - t.force;
  if (plan_.wheel) {
    forces.elastic = vector_at(motion + force_at);
    forces.moved = t.u - pair_at(work.next, c.row);
    correct_wheel_sums(node, after, forces, part.sums);
  } else {
    const Vec2 u = t.u + model_.dt * after;
    work.next[2 * c.row] = u.x;
    work.next[2 * c.row + 1] = u.y;
    correct_sums(*work.step, node, after, forces, part.sums);
  }
  if (model_.friction_work)
    model_.friction_work->add(work.step->contact->rotation * node.arm, active);
  std::vector<ActiveContact>& all = work.contacts->active;
  if (work.last) all.insert(all.end(), active.begin(), active.end());
}

/// The force of the elements and K on a row.
Vec2 SparseIntegrator::force_on(const double* now, int row) const noexcept {
  const auto r = static_cast<std::size_t>(row);
  RONDO_ASSERT(rubber_ && r / lanes + 1 < plan_.matrix.start.size(), row, plan_.n_packs);
  Vec2 force = rubber_->force_on(row);
  for (std::int64_t place = plan_.matrix.start[r / lanes];
       place < plan_.matrix.start[r / lanes + 1]; ++place) {
    const std::size_t at = static_cast<std::size_t>(place) * lanes + r % lanes;
    const double *k = plan_.matrix.blocks.data() + 4 * at,
                 *u = now + plan_.matrix.column.data()[at];
    force += Vec2{k[0] * u[0] + k[1] * u[1], k[2] * u[0] + k[3] * u[1]};
  }
  return force;
}

/// Load on a row.
Vec2 SparseIntegrator::load_on(const Work& work, int row) const noexcept {
  Vec2 load;
  if (plan_.first_load.empty()) return load;
  const auto i = static_cast<std::size_t>(row);
  for (int l = plan_.first_load[i / lanes]; l < plan_.first_load[i / lanes + 1]; ++l) {
    const auto at = static_cast<std::size_t>(l);
    load += work.step->pressures[plan_.load_of[at]] *
            vector_at(plan_.loads.data() + at * 2 * lanes + i % lanes);
  }
  return load;
}

void SparseIntegrator::update_rows(const Work& work, std::size_t block,
                                   PartialStep& part) noexcept {
  std::array<double, kernels::most_sums * lanes> sums;
  kernels::SparseRows rows = rows_from(work.now, work.next, block);
  rows.step = &work.step->factors;
  rows.wheel = &work.step->wheel;
  rows.sums = sums.data();
  const bool loaded = !plan_.first_load.empty();
  rows.first_load = plan_.first_load.data();
  rows.loads = plan_.loads.data();
  rows.load_of = plan_.load_of.data();
  rows.pressures = work.step->pressures;
  const kernels::Terms& terms = work.step->terms;
  if (plan_.wheel)
    (rubber_ ? table_.rubber->wheel_rows : table_.wheel->rows)[work.step->heavy](rows);
  else if (rubber_)
    table_.rubber->rows[loaded][terms.stiffness_damping][terms.unsteady](rows);
  else
    table_.sparse_rows[loaded][terms.stiffness_damping][terms.unsteady](rows);
  const std::size_t n_sums = n_sums_of(plan_.wheel, rubber_.has_value());
  for (std::size_t k = 0; k < n_sums; ++k) part.sums[k] = sum_of_lanes(sums.data() + k * lanes);
}

/// K, fields and constants of a block's packs.
kernels::SparseRows SparseIntegrator::rows_from(const double* now, double* next,
                                                std::size_t block) noexcept {
  kernels::SparseRows rows{};
  rows.start = plan_.matrix.start.data();
  rows.blocks = plan_.matrix.blocks.data();
  rows.column = plan_.matrix.column.data();
  rows.constants = plan_.constants.data();
  rows.rubber = rubber_ ? &rubber_->rows() : nullptr;
  rows.now = now;
  rows.next = next;
  rows.motion = motion_.data();
  rows.first_pack = static_cast<std::ptrdiff_t>(plan_.first_pack(block));
  rows.last_pack = static_cast<std::ptrdiff_t>(plan_.first_pack(block + 1));
  return rows;
}

void SparseIntegrator::go_on(const kernels::WheelWay& way, long long step, Share share) noexcept {
  const std::size_t n = plan_.n_blocks;
  double* next = u_[parity(step + 1)].data();
  for (std::size_t block = share.first(n); block < share.last(n); ++block) {
    kernels::SparseRows rows = rows_from(u_[parity(step)].data(), next, block);
    rows.way = &way;
    table_.wheel->rows_way(rows);
    if (block + 1 == n) rest_padding(next);
  }
}

/// Puts the rows that fill up the last pack to rest: they have no mass and no stiffness, but the
/// pull and the frame would move them without end, as nothing holds them.
void SparseIntegrator::rest_padding(double* next) noexcept {
  for (std::size_t i = plan_.node.size(); i < plan_.n_packs * lanes; ++i) {
    put(motion_.data() + motion_at(i), {});
    next[2 * i] = next[2 * i + 1] = 0.0;
  }
}

void SparseIntegrator::make_block(const Work& work, std::size_t block) noexcept {
  PartialStep& part = work.parts[block];
  part.contact = {};
  const bool contacts = work.step->contact && !has_massless_contact(model_);
  if (contacts) find_touching(work, block);
  if (!kept_.empty()) forget_impulses(block);
  update_rows(work, block, part);
  if (contacts)
    for (const Touching& t : work.contacts->touching) solve_node(work, t, part);
  if (block + 1 == plan_.n_blocks && !plan_.wheel) rest_padding(work.next);
}

/// The rows read forces of all elements around them, and loads.
void SparseIntegrator::evaluate_rubber(const Work& work, Share share) noexcept {
  const std::size_t n = rubber_->n_blocks();
  for (std::size_t block = share.first(n); block < share.last(n); ++block)
    rubber_->evaluate(work.now, block);
  if (following_ && share.thread == 0) following_->update(work.now, plan_);
  wait_for_others(share);
}

/// A thread's blocks are the same in every step. A product reads u of other threads' blocks: all of
/// it must be there.
void SparseIntegrator::make_steps(const Batch& batch, Share share) noexcept {
  const std::size_t n = plan_.n_blocks;
  RONDO_ASSERT(share.thread < contacts_.size(), share.thread, contacts_.size());
  // Contacts of this thread, and of those that are not there this time.
  for (std::size_t k = share.thread; k < contacts_.size(); k += share.n_threads)
    contacts_[k].active.clear();
  for (std::size_t i = 0; i < batch.steps.size(); ++i) {
    const long long step = batch.first + static_cast<long long>(i);
    const Work work{&batch.steps[i],
                    u_[parity(step)].data(),
                    u_[parity(step + 1)].data(),
                    batch.parts + i * n_parts_,
                    &contacts_[share.thread],
                    i + 1 == batch.steps.size(),
                    batch.rubber + i};
    if (rubber_) evaluate_rubber(work, share);
    for (std::size_t block = share.first(n); block < share.last(n); ++block)
      make_block(work, block);
    if (rubber_ && share.thread == 0) *work.rubber = rubber_->energy();
    wait_for_others(share);
  }
}

}  // namespace rondo::dynamics
