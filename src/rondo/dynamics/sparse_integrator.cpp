// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/sparse_integrator.hpp"

#include <omp.h>

#include <algorithm>

namespace rondo::dynamics {
namespace {

constexpr std::size_t most_steps_in_a_batch = 64;
constexpr std::size_t lanes = kernels::lanes;
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
/// Of all lanes, in pairs, so that few sums wait for others.
double sum_of(const double* x) noexcept {
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

}  // namespace

SparseIntegrator::SparseIntegrator(const Model& model, const State& start,
                                   const kernels::Table& table)
    : model_(model),
      table_(table),
      plan_(make_sparse_plan(model)),
      u_{LargeArray(plan_.n_packs * 2 * lanes), LargeArray(plan_.n_packs * 2 * lanes)},
      motion_(plan_.n_packs * plan_.motion_size()),
      steps_(most_steps_in_a_batch),
      parts_(most_steps_in_a_batch * plan_.n_blocks),
      touching_(static_cast<std::size_t>(model.threads)),
      active_(2 * plan_.candidates.size()),
      n_active_(plan_.candidates.size()),
      step_(start.step) {
  for (std::vector<Touching>& touching : touching_) touching.reserve(plan_.candidates.size());
  load(start);
}

std::size_t SparseIntegrator::motion_at(std::size_t row) const noexcept {
  return row / lanes * plan_.motion_size() + row % lanes;
}

void SparseIntegrator::load(const State& start) {
  for (std::size_t i = 0; i < plan_.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(plan_.node[i]);
    const Vec2 u = start.u[node] + model_.dt * start.v_next[node];
    u_[now_].data()[2 * i] = u.x;
    u_[now_].data()[2 * i + 1] = u.y;
    double* motion = motion_.data() + motion_at(i);
    put(motion, start.v_next[node]);
    if (plan_.keeps_force) put(motion + force_at, start.force[node]);
  }
}

void SparseIntegrator::save_displacement(std::vector<Vec2>& u) const noexcept {
  for (std::size_t i = 0; i < plan_.node.size(); ++i)
    u[static_cast<std::size_t>(plan_.node[i])] = pair_at(u_[now_].data(), static_cast<int>(i));
}

void SparseIntegrator::save_velocity(std::vector<Vec2>& v) const noexcept {
  for (std::size_t i = 0; i < plan_.node.size(); ++i)
    v[static_cast<std::size_t>(plan_.node[i])] = vector_at(motion_.data() + motion_at(i));
}

void SparseIntegrator::save_active(std::vector<ActiveContact>& active) const noexcept {
  active.clear();
  for (std::size_t k = 0; k < n_active_.size(); ++k) {
    const auto first = active_.begin() + static_cast<std::ptrdiff_t>(2 * k);
    active.insert(active.end(), first, first + n_active_[k]);
  }
}

void SparseIntegrator::find_touching(const Work& work, std::size_t block,
                                     std::vector<Touching>& touching) const noexcept {
  touching.clear();
  const ContactStep& contact = *work.step->contact;
  constexpr double margin = 1e-9;  // m: the nodes found are looked at again, exactly
  const double limit = model_.contact->ground.top() - contact.center.y + margin;
  const Vec2 up = {contact.rotation.y, contact.rotation.x};
  const double* u = work.now;
  const SparseCandidate* candidates = plan_.candidates.data();
  const std::size_t last = plan_.first_candidate[block + 1];
  for (std::size_t i = plan_.first_candidate[block]; i < last; ++i) {
    const SparseCandidate& c = candidates[i];
    if (dot(up, c.reference + pair_at(u, c.row)) <= limit) look_at(work, c, touching);
  }
}

void SparseIntegrator::look_at(const Work& work, const SparseCandidate& c,
                               std::vector<Touching>& touching) const noexcept {
  const ContactStep& contact = *work.step->contact;
  const Vec2 u = pair_at(work.now, c.row);
  const contact::Touches touches =
      model_.contact->ground.touches(contact.center + contact.rotation * (c.reference + u));
  if (touches.count == 0) return;
  const double* motion = motion_.data() + motion_at(static_cast<std::size_t>(c.row));
  touching.push_back({c, touches, u, vector_at(motion),
                      plan_.keeps_force ? vector_at(motion + force_at) : Vec2{}});
}

void SparseIntegrator::solve_node(const Work& work, const Touching& t, PartialStep& part) noexcept {
  const SparseCandidate& c = t.candidate;
  const auto k = static_cast<std::size_t>(c.candidate);
  double* motion = motion_.data() + motion_at(static_cast<std::size_t>(c.row));
  const ContactNode node{k,
                         model_.mass[static_cast<std::size_t>(model_.contact->nodes[k])],
                         model_.contact->tributary[k],
                         c.reference + t.u,
                         t.v,
                         vector_at(motion)};
  std::array<ActiveContact, 2> contacts;
  const std::span active(contacts.data(), static_cast<std::size_t>(t.touches.count));
  const Vec2 after = solve_contacts(*work.step->contact, node, t.touches, active, part.contact);
  put(motion, after);
  const Vec2 u = t.u + model_.dt * after;
  work.next[2 * c.row] = u.x;
  work.next[2 * c.row + 1] = u.y;
  const Vec2 change = plan_.keeps_force ? vector_at(motion + force_at) - t.force : Vec2{};
  correct_sums(*work.step, node, after, change, part.sums);
  if (!work.last) return;
  n_active_[k] = t.touches.count;
  std::copy(active.begin(), active.end(), active_.begin() + static_cast<std::ptrdiff_t>(2 * k));
}

void SparseIntegrator::update_rows(const Work& work, std::size_t block,
                                   PartialStep& part) noexcept {
  std::array<double, kernels::n_sums * lanes> sums;
  kernels::SparseRows rows;
  rows.start = plan_.start.data();
  rows.blocks = plan_.blocks.data();
  rows.column = plan_.column.data();
  rows.constants = plan_.constants.data();
  rows.now = work.now;
  rows.next = work.next;
  rows.motion = motion_.data();
  rows.first_pack = static_cast<std::ptrdiff_t>(plan_.first_pack(block));
  rows.last_pack = static_cast<std::ptrdiff_t>(plan_.first_pack(block + 1));
  rows.step = &work.step->factors;
  rows.sums = sums.data();
  const kernels::Terms& terms = work.step->terms;
  table_.sparse_rows[terms.stiffness_damping][terms.printed][terms.unsteady](rows);
  for (std::size_t k = 0; k < part.sums.size(); ++k) part.sums[k] = sum_of(sums.data() + k * lanes);
}

/// What fills up the last pack has no mass and no stiffness, but the pull and the frame move it:
/// without end, as nothing holds it.
void SparseIntegrator::rest_padding(double* next) noexcept {
  for (std::size_t i = plan_.node.size(); i < plan_.n_packs * lanes; ++i) {
    put(motion_.data() + motion_at(i), {});
    next[2 * i] = next[2 * i + 1] = 0.0;
  }
}

void SparseIntegrator::make_block(const Work& work, std::size_t block,
                                  std::vector<Touching>& touching) noexcept {
  PartialStep& part = work.parts[block];
  part.contact = {};
  if (work.step->contact) find_touching(work, block, touching);
  update_rows(work, block, part);
  if (work.step->contact)
    for (const Touching& t : touching) solve_node(work, t, part);
  if (block + 1 == plan_.n_blocks) rest_padding(work.next);
}

/// A thread's blocks are the same in every step. A product reads u of other threads' blocks: all of
/// it must be there.
void SparseIntegrator::steps_of(std::size_t n_steps, std::size_t thread,
                                std::size_t n_threads) noexcept {
  const std::size_t n = plan_.n_blocks;
  for (std::size_t i = 0; i < n_steps; ++i) {
    const Work work{&steps_[i], u_[(now_ + i) % 2].data(), u_[(now_ + i + 1) % 2].data(),
                    parts_.data() + i * n, i + 1 == n_steps};
    for (std::size_t block = n * thread / n_threads; block < n * (thread + 1) / n_threads; ++block)
      make_block(work, block, touching_[thread]);
    if (n_threads > 1) barrier_.wait(static_cast<unsigned>(n_threads));
  }
}

void SparseIntegrator::make_steps(std::size_t n_steps) noexcept {
  const int threads = std::min(model_.threads, static_cast<int>(plan_.n_blocks));
  if (threads > 1) {
#pragma omp parallel num_threads(threads)
    steps_of(n_steps, static_cast<std::size_t>(omp_get_thread_num()),
             static_cast<std::size_t>(omp_get_num_threads()));
  } else {
    steps_of(n_steps, 0, 1);
  }
  now_ = (now_ + n_steps) % 2;
}

void SparseIntegrator::advance_batch(std::span<StepReport> reports) noexcept {
  const std::size_t n = plan_.n_blocks;
  for (std::size_t i = 0; i < reports.size(); ++i)
    steps_[i] = step_context(model_, step_ + 1 + static_cast<long long>(i));
  make_steps(reports.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const std::span parts = std::span<const PartialStep>(parts_).subspan(i * n, n);
    const WholeStep whole = whole_step(model_, steps_[i].frame, parts);
    ledger_.add(whole.energy);
    reports[i] = {++step_, steps_[i].frame, whole.contact, ledger_.last()};
  }
}

void SparseIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  std::span before = reports.first(reports.size() - (last ? 1 : 0));
  while (!before.empty()) {
    const std::size_t n = std::min(before.size(), most_steps_in_a_batch);
    advance_batch(before.first(n));
    before = before.subspan(n);
  }
  if (!last) return;
  save_displacement(last->u);
  save_velocity(last->v);
  std::fill(n_active_.begin(), n_active_.end(), 0);
  advance_batch(reports.last(1));
  if (!last->v_next.empty()) save_velocity(last->v_next);
  save_active(last->active);
  last->step = step_;
  last->frame = reports.back().frame;
}

void SparseIntegrator::fields(State& state) const noexcept {
  save_displacement(state.u);
  save_velocity(state.v_next);
}

}  // namespace rondo::dynamics
