// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/solid/corner_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/contact/cone_pair.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/integrators/general/late_contact.hpp"
#include "rondo/integrators/general/readable_step.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::dynamics {
namespace {

using contact::KeptImpulses;
using contact::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_key_of_corner(std::uint64_t key) noexcept {
  return key >> 62U == static_cast<std::uint64_t>(ContactKind::corner);
}

/// Marks the key of the part of an impulse along the edges of the ground.
constexpr std::uint64_t along_line = 1ULL << 61U;

Vec3 impulse_before(const KeptImpulses& before, std::uint64_t key) noexcept {
  return {contact::kept_impulse(before, key), contact::kept_impulse(before, key | along_line).x};
}

/// Sweeps and steps of least squares after which a problem counts as beyond the solver.
constexpr int most_iterations = 400;

/// Σ H_i value(node i).
template <class Value>
Vec3 sum_over_nodes(const CornerRow& row, Value&& value) {
  Vec3 w;
  for (int i = 0; i < row.count; ++i)
    w += contact::apply(row.block[at(i)], value(at(row.node[at(i)])));
  return w;
}

/// Σ H_j G H_lᵀ over the nodes that both contacts have.
contact::SpatialBlock coupling_of(const SolidContactStep& step, const Model& model,
                                  const CornerRow& j, const CornerRow& l) noexcept {
  contact::SpatialBlock w{};
  for (int a = 0; a < j.count; ++a)
    for (int b = 0; b < l.count; ++b) {
      if (j.node[at(a)] != l.node[at(b)]) continue;
      const SolidMobility mobility(step, model.mass[at(j.node[at(a)])]);
      const contact::SpatialBlock& of_l = l.block[at(b)];
      const Vec3 columns[3] = {mobility * of_l[0], mobility * of_l[1], mobility * of_l[2]};
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 row = j.block[at(a)][i];
        w[i] += Vec3{dot(row, columns[0]), dot(row, columns[1]), dot(row, columns[2])};
      }
    }
  return w;
}

/// Turns a velocity of a row into the frame of its nodes: the normal of an edge's nodes is the
/// opposite one, the direction of the ground's edge is the same.
Vec3 of_node(const CornerRow& row, Vec3 a) noexcept {
  return row.kind == ContactKind::facet ? a : Vec3{a.x, a.y, -a.z};
}

}  // namespace

CornerSolver::CornerSolver(const Model& model)
    : model_(model),
      finder_(model),
      limits_{.most_iterations = std::min(most_iterations, model.coupled.most_iterations)} {
  RONDO_DEMAND(model.dt > 0.0 && model.mass.size() == model.n_nodes(), model.dt, model.mass.size(),
               model.n_nodes());
}

std::span<const CornerRow> CornerSolver::find(std::span<const CornerFinder::Near> near) {
  finder_.find(near, rows_);
  return rows_;
}

Vec3 CornerSolver::arm_of(const State& state, std::size_t node) const noexcept {
  return reference_of<Vec3>(model_, node) + state.u.space()[node];
}

void CornerSolver::solve(const SolidContactStep& step, const KeptImpulses& before, State& state,
                         ContactReport& report) {
  if (rows_.empty()) return;
  for (CornerRow& row : rows_) set_row(step, before, state, row);
  look_for_late(step, before, state.frame.time, report);
  node_start_.assign(1, 0);
  nodes_.clear();
  for (const CornerRow& row : rows_) {
    nodes_.insert(nodes_.end(), row.node.begin(), row.node.begin() + row.count);
    node_start_.push_back(static_cast<int>(nodes_.size()));
  }
  const contact::Clusters& clusters = cluster_finder_.find(node_start_, nodes_, model_.n_nodes());
  for (std::size_t k = 0; k < clusters.size(); ++k)
    solve_together(step, before, clusters[k], state, report);
}

/// w⁻, w without impulses, and the law.
void CornerSolver::set_row(const SolidContactStep& step, const KeptImpulses& before,
                           const State& state, CornerRow& row) const {
  const contact::Law& law = *step.plane.law;
  row.before = sum_over_nodes(row, [&](std::size_t k) {
    return velocity_before(step, arm_of(state, k), state.v.space()[k]);
  });
  row.free = sum_over_nodes(row, [&](std::size_t k) {
    return drive_of(step, arm_of(state, k)) + step.plane.rotation_next * state.v_next.space()[k];
  });
  row.impulse = {};
  row.status = Status::open;
  row.turning = row.kind == ContactKind::corner ? turning_of(step, row, state) : 0.0;
  row.bounce = contact::restitution_shift(law, row.before.x, row.before.x - row.turning);
  row.friction =
      law.friction.is_constant() ? law.friction.constant() : friction_of(step, before, state, row);
}

double CornerSolver::friction_of(const SolidContactStep& step, const KeptImpulses& before,
                                 const State& state, const CornerRow& row) const {
  Vec3 place;
  for (int i = 0; i < row.count; ++i)
    place += row.weight[at(i)] * place_in_space(step, arm_of(state, at(row.node[at(i)])));
  const double pressure =  // a line has none
      row.tributary > 0.0 ? contact::kept_impulse(before, row.key).x / (model_.dt * row.tributary)
                          : 0.0;
  return step.plane.law->friction.coefficient(
      {place, std::hypot(row.before.y, row.before.z), pressure});
}

/// (4.8c): what one more step like the last would do to the gap, over Δt, less w_n⁻.
double CornerSolver::turning_of(const SolidContactStep& step, const CornerRow& row,
                                const State& state) const {
  std::array<Vec2, 2> to;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t k = at(row.node[i]);
    const Vec3 velocity = velocity_before(step, arm_of(state, k), state.v.space()[k]);
    to[i] =
        finder_.places(row.set)[k] +
        model_.dt *
            axes_of(*model_.contact, row.set).from_ground(step.ground.from_wheel(velocity)).plane();
  }
  const Vec2 along = to[1] - to[0];
  const double gap = cross(row.point - to[0], along) / norm(along);
  return (gap - row.gap) / model_.dt - row.before.x;
}

/// It may have come in beside the edge.
bool CornerSolver::came_round(const CornerRow& row) const noexcept {
  const auto edge = static_cast<std::size_t>(row.key & ((1ULL << key_bits_of_edge) - 1));
  const std::span<const Vec2> places = finder_.places(row.set);
  return came_round_an_end(row.point, places[at(row.node[0])], places[at(row.node[1])],
                           model_.dt * row.before.y, finder_.edges().boundary.beside[edge]);
}

/// See GeneralContact::look_for_late.
void CornerSolver::look_for_late(const SolidContactStep& step, const KeptImpulses& before,
                                 double time, ContactReport& report) const {
  const double round_off = 1e-6 * finder_.deepest(), harmless = 0.1 * finder_.deepest();
  if (time < 1.25 * model_.dt) return;  // it may start so
  for (const CornerRow& row : rows_) {
    if (row.kind == ContactKind::facet || -row.gap <= std::max(report.late, harmless)) continue;
    const double gap_before = row.gap - step.plane.dt * row.before.x;
    if (-gap_before <= round_off + model_.dt * std::abs(row.turning) ||
        was_found(before, row.key) || came_round(row))
      continue;
    report.late = -row.gap;
    report.late_at = axes_of(*model_.contact, row.set).to_ground(row.point).plane();
  }
}

void CornerSolver::make_problem(const SolidContactStep& step, Rows rows) {
  problem_.free.clear();
  problem_.bounce.clear();
  problem_.friction.clear();
  problem_.blocks.clear();
  for (const int j : rows) {
    const CornerRow& row = rows_[at(j)];
    problem_.free.push_back(row.free + Vec3{row.turning, 0.0, 0.0});
    problem_.bounce.push_back(row.bounce);
    problem_.friction.push_back(row.friction);
    for (const int l : rows)
      problem_.blocks.push_back(coupling_of(step, model_, row, rows_[at(l)]));
  }
}

/// Two contacts of one node, as the two facets of a node that nothing else holds.
bool CornerSolver::solve_pair() {
  if (asked_.size() != 2) return false;
  const CornerRow &a = rows_[at(asked_[0])], &b = rows_[at(asked_[1])];
  if (a.count + b.count != 2 || a.node[0] != b.node[0] || a.set != b.set ||
      a.friction != b.friction)
    return false;
  const auto pair = contact::solve_spatial_pair(
      {a.free, problem_.block(0, 0), {a.bounce, b.bounce}, rotation_between(a.normal, b.normal)},
      a.friction);
  if (!pair.converged) return false;
  impulse_ = {pair.contact[0].impulse, pair.contact[1].impulse};
  status_ = {pair.contact[0].status, pair.contact[1].status};
  return true;
}

/// Contacts that hold nearly the same by several normals may be beyond the solver. Then the nearer
/// node of each edge is held in place of the edge; and if that is not solved either, the corners
/// that are the least deep, a quarter of all, are left out of this step, and so on.
contact::CoupledResult CornerSolver::solve_problem(const SolidContactStep& step,
                                                   const KeptImpulses& before, Rows rows,
                                                   const State& state, ContactReport& report) {
  asked_.assign(rows.begin(), rows.end());
  contact::CoupledResult result = try_to_solve(step, before);
  if (result.converged) return result;
  for (const int j : asked_)
    if (rows_[at(j)].kind == ContactKind::corner) {
      rows_[at(j)] = finder_.at_nearer_node(rows_[at(j)]);
      set_row(step, before, state, rows_[at(j)]);
    }
  result = try_to_solve(step, before);
  const auto is_corner = [&](int j) { return is_key_of_corner(rows_[at(j)].key); };
  while (!result.converged && std::ranges::any_of(asked_, is_corner)) {
    const auto depth = [&](int j) { return is_corner(j) ? -rows_[at(j)].gap : infinity; };
    for (auto left = (std::ranges::count_if(asked_, is_corner) + 3) / 4; left > 0; --left) {
      asked_.erase(std::ranges::min_element(asked_, {}, depth));
      ++report.clusters_not_converged;
    }
    result = try_to_solve(step, before);
  }
  return result;
}

contact::CoupledResult CornerSolver::try_to_solve(const SolidContactStep& step,
                                                  const KeptImpulses& before) {
  make_problem(step, asked_);
  if (solve_pair()) return {.iterations = 1, .residual = 0.0, .converged = true};
  impulse_.clear();
  for (const int j : asked_) impulse_.push_back(impulse_before(before, rows_[at(j)].key));
  status_.assign(asked_.size(), Status::open);
  return contact::solve_coupled(problem_, limits_, impulse_, status_, work_);
}

void CornerSolver::solve_together(const SolidContactStep& step, const KeptImpulses& before,
                                  Rows rows, State& state, ContactReport& report) {
  const contact::CoupledResult result = solve_problem(step, before, rows, state, report);
  for (std::size_t j = 0; j < asked_.size(); ++j) {
    rows_[at(asked_[j])].impulse = impulse_[j];
    rows_[at(asked_[j])].status = status_[j];
  }
  push_nodes(step, asked_, result.converged, state);
  for (std::size_t j = 0; j < asked_.size(); ++j) {
    CornerRow& row = rows_[at(asked_[j])];
    finish(step, row, state, report);
    const double mass = problem_.mass(j);
    const double residual =
        contact::law_residual(row.impulse, row.after + Vec3{row.turning, 0.0, 0.0}, row.bounce,
                              row.friction, mass) /
        mass;
    report.residual = keep_larger(report.residual, residual);
  }
  if (rows.size() > 1) ++report.clusters;
  report.clusters_not_converged += result.converged ? 0 : 1;
  report.cluster_largest = std::max(report.cluster_largest, static_cast<int>(rows.size()));
  report.cluster_iterations = std::max(report.cluster_iterations, result.iterations);
}

/// A node that sticks to a facet gets the velocity that w = (-bounce, 0, 0) means, so that sticking
/// is exact.
void CornerSolver::push_nodes(const SolidContactStep& step, Rows rows, bool converged,
                              State& state) const {
  for (const int j : rows) {
    const CornerRow& row = rows_[at(j)];
    if (row.impulse == Vec3{}) continue;
    for (int i = 0; i < row.count; ++i) {
      const std::size_t k = at(row.node[at(i)]);
      state.v_next.space()[k] +=
          velocity_change(step, model_.mass[k], contact::transposed(row.block[at(i)], row.impulse));
    }
  }
  for (const int j : rows) {
    const CornerRow& row = rows_[at(j)];
    if (!converged || row.kind != ContactKind::facet || row.status != Status::stick) continue;
    const std::size_t k = at(row.node[0]);
    const Vec3 rest = contact::transposed(row.block[0], {-row.bounce, 0.0, 0.0}) -
                      drive_of(step, arm_of(state, k));
    state.v_next.space()[k] = conj(step.plane.rotation_next) * rest;
  }
}

/// w⁺, works (5.3) and figures of a contact.
void CornerSolver::finish(const SolidContactStep& step, CornerRow& row, State& state,
                          ContactReport& report) {
  row.after = sum_over_nodes(row, [&](std::size_t k) {
    return drive_of(step, arm_of(state, k)) + step.plane.rotation_next * state.v_next.space()[k];
  });
  double work = 0.0;
  for (int i = 0; i < row.count; ++i) {
    const std::size_t k = at(row.node[at(i)]);
    const Vec3 push = contact::transposed(row.block[at(i)], row.impulse);
    work +=
        dot(conj(step.plane.rotation) * push, 0.5 * (state.v.space()[k] + state.v_next.space()[k]));
    add_impulse(step, step.plane.rotation * arm_of(state, k), push, report);
  }
  const Vec3 mean = 0.5 * (row.before + row.after), r = row.impulse;
  report.work += work;
  report.dissipation_friction -= r.y * mean.y + r.z * mean.z;
  report.loss_impact -= r.x * mean.x;
  report.work_rim += work - dot(r, mean);
  report.penetration = std::max(report.penetration, -row.gap);
  report.free_velocity = std::max(report.free_velocity, norm(row.free));
  if (row.impulse.x > 0.0) {
    ++report.nodes;
    report.sticking += row.status == Status::stick ? 1 : 0;
    report.length += row.tributary;
  }
  add_active(step, row, state);
}

/// A node on a facet is pushed along the normal, the nodes of an edge against it.
void CornerSolver::add_active(const SolidContactStep& step, const CornerRow& row,
                              State& state) const {
  const contact::EdgeAxes& axes = axes_of(*model_.contact, row.set);
  for (int i = 0; i < row.count; ++i) {
    const Vec3 push = step.ground.from_wheel(contact::transposed(row.block[at(i)], row.impulse));
    ActiveContact a;
    a.candidate = finder_.candidate_of(row.node[at(i)]);
    a.space.normal = axes.to_ground(row.kind == ContactKind::facet ? row.normal : -row.normal);
    a.space.line = axes.to_ground({0.0, 0.0, 1.0});
    a.gap = row.gap;
    a.before = of_node(row, row.before);
    a.free = of_node(row, row.free);
    a.after = of_node(row, row.after);
    a.bounce = row.bounce;
    a.friction = row.friction;
    a.impulse = a.space.to(push);
    a.status = row.status;
    state.active.push_back(a);
  }
}

void CornerSolver::add_impulses_to(KeptImpulses& kept) const {
  for (const CornerRow& row : rows_) {
    kept.emplace_back(row.key, row.impulse.plane());
    kept.emplace_back(row.key | along_line, Vec2{row.impulse.z, 0.0});
  }
  for (const std::uint64_t key : finder_.left_to_others()) kept.emplace_back(key, Vec2{});
}

}  // namespace rondo::dynamics
