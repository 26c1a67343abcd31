// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/general_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/contact/residual.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/integrators/general/late_contact.hpp"

namespace rondo::dynamics {
namespace {

using contact::ContactRows;
using contact::Status;

/// Σ H_i value(node i).
template <class Value>
Vec2 row_sum(const ContactRows& rows, Value&& value) {
  Vec2 w;
  for (int i = 0; i < rows.count; ++i)
    w += contact::apply(rows.block[at(i)], value(at(rows.node[at(i)])));
  return w;
}

Vec2 arm_of(const Model& model, const State& state, std::size_t k) noexcept {
  return model.reference[k] + state.u.plane()[k];
}

/// (x_{n+2} - x_{n+1})/Δt that a velocity v⁺ means, fixed frame.
Vec2 velocity_after(const ContactStep& step, Vec2 arm, Vec2 v) noexcept {
  return drive_of(step, arm) + step.rotation_next * v;
}

}  // namespace

GeneralContact::GeneralContact(const Model& model)
    : model_(model),
      finder_(model),
      response_(model.n_nodes()),
      coupled_({.most_iterations = model.coupled.most_iterations}, model.coupled.dump_above) {
  const std::vector<int>* nodes = model.contact    ? &model.contact->nodes
                                  : model.surfaces ? &model.surfaces->nodes
                                                   : nullptr;
  if (!nodes) return;
  RONDO_DEMAND(model.dt > 0.0 && model.mass.size() == model.n_nodes(), model.dt, model.mass.size(),
               model.n_nodes());
  RONDO_ASSERT(!model.contact || !model.surfaces || model.contact->nodes == model.surfaces->nodes,
               nodes->size());  // one numbering of the candidates
  candidate_ = places_among(*nodes, model.n_nodes());
}

std::span<const ContactRow> GeneralContact::find(const State& state) {
  if (model_.contact || model_.surfaces) finder_.find(state, rows_);
  if (!held_.empty())
    std::erase_if(rows_, [&](const ContactRow& row) {
      const int candidate = candidate_[at(row.rows.node[0])];
      return candidate >= 0 && held_[at(candidate)];
    });
  return rows_;
}

ContactReport GeneralContact::solve(const BodyFrames& frames, Vec2 center, State& state) {
  find(state);
  return solve_found(frames, center, state);
}

std::span<const ContactRow> GeneralContact::find_at_corners(const State& state,
                                                            std::span<const NearCorner> near,
                                                            std::span<const int> nodes) {
  finder_.find_at_corners(state, near, nodes, rows_);
  return rows_;
}

ContactReport GeneralContact::solve_found(const BodyFrames& frames, Vec2 center, State& state) {
  RONDO_ASSERT(state.v.size() == model_.n_nodes() && state.v_next.size() == model_.n_nodes(),
               state.v.size(), state.v_next.size(), model_.n_nodes());
  ContactReport report;
  state.active.clear();
  center_ = center;
  if (rows_.empty()) {
    coupled_.kept.clear();
    return report;
  }
  set_velocities(frames, state);
  look_for_late(frames, report);
  find_clusters();
  const contact::Clusters& clusters = cluster_finder_.find(node_start_, nodes_, model_.n_nodes());
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    if (one_node_on_ground(clusters[k]))
      solve_on_ground(frames, clusters[k], state, report);
    else
      solve_together(frames, clusters[k], state, report);
  }
  keep_impulses();
  sort_by_candidate(state.active);
  return report;
}

/// (4.8c): what one more step like the last would do to the gap, over Δt, less w_n⁻.
double GeneralContact::turning_of(const BodyFrames& frames, const ContactRow& row,
                                  const State& state) const {
  const auto travel = [&](int node) {
    const auto k = at(node);
    return model_.dt * velocity_before(frames.of(model_, k).contact, arm_of(model_, state, k),
                                       state.v.plane()[k]);
  };
  const bool corner = row.kind == ContactKind::corner;
  const int a = row.rows.node[corner ? 0 : 1], b = row.rows.node[corner ? 1 : 2];
  const Vec2 to_a = finder_.positions()[at(a)] + travel(a);
  const Vec2 to_b = finder_.positions()[at(b)] + travel(b);
  const Vec2 to_p = row.point + (corner ? Vec2{} : travel(row.rows.node[0]));
  const double gap = cross(to_p - to_a, to_b - to_a) / norm(to_b - to_a);
  return (gap - row.gap) / model_.dt - row.before.x;
}

/// w⁻ and w without impulses of every row, and the Delassus operators of their nodes.
void GeneralContact::set_velocities(const BodyFrames& frames, const State& state) {
  for (ContactRow& row : rows_) {
    RONDO_ASSERT(row.law && row.rows.count >= 1, row.key, row.rows.count);
    row.before = row_sum(row.rows, [&](std::size_t k) {
      return velocity_before(frames.of(model_, k).contact, arm_of(model_, state, k),
                             state.v.plane()[k]);
    });
    row.free = row_sum(row.rows, [&](std::size_t k) {
      const ContactStep& step = frames.of(model_, k).contact;
      RONDO_ASSERT(model_.mass[k] > 0.0, k, model_.mass[k]);
      response_[k] = step.turn / (model_.mass[k] * step.a);
      return velocity_after(step, arm_of(model_, state, k), state.v_next.plane()[k]);
    });
    row.turning = row.kind == ContactKind::facet ? 0.0 : turning_of(frames, row, state);
    row.bounce = contact::restitution_shift(*row.law, row.before.x, row.before.x - row.turning);
    row.impulse = {};
    row.status = Status::open;
  }
}

/// It may have come in beside the segment.
bool GeneralContact::came_round(const ContactRow& row) const noexcept {
  const bool corner = row.kind == ContactKind::corner;
  const auto place = [&](std::size_t i) { return finder_.positions()[at(row.rows.node[i])]; };
  return came_round_an_end(row.point, place(corner ? 0 : 1), place(corner ? 1 : 2),
                           model_.dt * row.before.y, finder_.beside(row));
}

/// A point that was behind its segment in the step before, and was found behind none then, has been
/// met by nothing. In the first step of a run it may start so. A boundary that is bent by much has
/// such places at its joints (4.8a), of a depth that does no harm.
void GeneralContact::look_for_late(const BodyFrames& frames, ContactReport& report) const noexcept {
  const double round_off = 1e-6 * finder_.deepest(), harmless = 0.1 * finder_.deepest();
  for (const ContactRow& row : rows_) {
    if (row.kind == ContactKind::facet || -row.gap <= std::max(report.late, harmless)) continue;
    const double gap_before = row.gap - model_.dt * row.before.x;
    if (-gap_before <= round_off + model_.dt * std::abs(row.turning) ||
        was_found(coupled_.kept, row.key))
      continue;
    const double time = frames.of(model_, at(row.rows.node[0])).frame.time;
    if (time < 1.25 * model_.dt || came_round(row)) continue;
    report.late = -row.gap;
    report.late_at = row.point;
  }
}

void GeneralContact::find_clusters() {
  node_start_.assign(1, 0);
  nodes_.clear();
  for (const ContactRow& row : rows_) {
    nodes_.insert(nodes_.end(), row.rows.node.begin(), row.rows.node.begin() + row.rows.count);
    node_start_.push_back(static_cast<int>(nodes_.size()));
  }
}

bool GeneralContact::one_node_on_ground(Rows rows) const {
  const int node = rows_[at(rows[0])].rows.node[0];
  return std::all_of(rows.begin(), rows.end(), [&](int j) {
    return rows_[at(j)].kind == ContactKind::facet && rows_[at(j)].rows.node[0] == node;
  });
}

void GeneralContact::solve_on_ground(const BodyFrames& frames, Rows rows, State& state,
                                     ContactReport& report) {
  const auto k = at(rows_[at(rows[0])].rows.node[0]);
  RONDO_ASSERT(candidate_[k] >= 0 && rows.size() <= 2, k, rows.size());  // facets at a node
  const auto i = at(candidate_[k]);
  contact::Touches touches;
  for (const int j : rows)
    touches.at[at(touches.count++)] = {rows_[at(j)].gap, rows_[at(j)].normal};
  std::array<ActiveContact, 2> contacts;
  const std::span active(contacts.data(), rows.size());
  ContactNode node{i,
                   model_.mass[k],
                   model_.contact->tributary[i],
                   arm_of(model_, state, k),
                   state.v.plane()[k],
                   state.v_next.plane()[k],
                   {}};
  for (std::size_t j = 0; j < rows.size(); ++j)
    node.pressure[j] = pressure_before(rows_[at(rows[j])]);
  const ContactStep& step = frames.of(model_, k).contact;
  const Vec3 before = report.impulse;
  state.v_next.plane()[k] = solve_contacts(step, node, touches, active, report);
  // The moment was taken about the center of the node's frame.
  report.angular_impulse += cross(step.center - center_, (report.impulse - before).plane());
  state.active.insert(state.active.end(), active.begin(), active.end());
  for (std::size_t j = 0; j < rows.size(); ++j)
    rows_[at(rows[j])].impulse = active[j].impulse.plane();
}

void GeneralContact::make_problem(Rows rows) {
  cluster_rows_.clear();
  coupled_.clear();
  for (const int j : rows) {
    ContactRow& row = rows_[at(j)];
    row.friction =
        row.law->friction.coefficient({row.point, std::abs(row.before.y), pressure_before(row)});
    cluster_rows_.push_back(row.rows);
    coupled_.add(row.free + Vec2{row.turning, 0.0}, row.bounce, row.friction,
                 coupled_.kept_of(row.key));
  }
  delassus_.build(cluster_rows_, response_, coupled_.problem);
}

void GeneralContact::solve_together(const BodyFrames& frames, Rows rows, State& state,
                                    ContactReport& report) {
  make_problem(rows);
  const contact::CoupledResult& result = coupled_.solve();
  for (std::size_t j = 0; j < rows.size(); ++j) {
    rows_[at(rows[j])].impulse = coupled_.impulse[j];
    rows_[at(rows[j])].status = coupled_.status[j];
  }
  add_impulses(frames, rows, result.converged, state);
  for (std::size_t j = 0; j < rows.size(); ++j)
    finish_row(frames, rows_[at(rows[j])], coupled_.problem.mass[j], state, report);
  if (rows.size() > 1) ++report.clusters;
  report.clusters_not_converged += result.converged ? 0 : 1;
  report.cluster_largest = std::max(report.cluster_largest, static_cast<int>(rows.size()));
  report.cluster_iterations = std::max(report.cluster_iterations, result.iterations);
}

/// v⁺ = v_free + Σ Rᵀ Hᵀ r/(m a). A node that sticks to the ground gets the velocity that w =
/// (-bounce, 0) means, so that sticking is exact (4.6).
void GeneralContact::add_impulses(const BodyFrames& frames, Rows rows, bool converged,
                                  State& state) {
  for (const int j : rows) {
    const ContactRow& row = rows_[at(j)];
    if (row.impulse == Vec2{}) continue;
    for (int i = 0; i < row.rows.count; ++i) {
      const auto k = at(row.rows.node[at(i)]);
      const ContactStep& step = frames.of(model_, k).contact;
      const Vec2 impulse = contact::transposed(row.rows.block[at(i)], row.impulse);
      state.v_next.plane()[k] += conj(step.rotation) * impulse / (model_.mass[k] * step.a);
    }
  }
  if (!converged) return;
  for (const int j : rows) {
    const ContactRow& row = rows_[at(j)];
    if (row.kind != ContactKind::facet || row.status != Status::stick) continue;
    const auto k = at(row.rows.node[0]);
    const ContactStep& step = frames.of(model_, k).contact;
    state.v_next.plane()[k] =
        conj(step.rotation_next) *
        (from_frame(row.normal, {-row.bounce, 0.0}) - drive_of(step, arm_of(model_, state, k)));
  }
}

/// w⁺, works (5.3) and figures of a row of a cluster.
void GeneralContact::finish_row(const BodyFrames& frames, ContactRow& row, double mass,
                                State& state, ContactReport& report) {
  row.after = row_sum(row.rows, [&](std::size_t k) {
    return velocity_after(frames.of(model_, k).contact, arm_of(model_, state, k),
                          state.v_next.plane()[k]);
  });
  double work = 0.0;
  for (int i = 0; i < row.rows.count; ++i) {
    const auto k = at(row.rows.node[at(i)]);
    const Vec2 impulse = conj(frames.of(model_, k).contact.rotation) *
                         contact::transposed(row.rows.block[at(i)], row.impulse);
    work += dot(impulse, 0.5 * (state.v.plane()[k] + state.v_next.plane()[k]));
  }
  const Vec2 mean = 0.5 * (row.before + row.after);
  report.work += work;
  report.dissipation_friction -= row.impulse.y * mean.y;
  report.loss_impact -= row.impulse.x * mean.x;
  report.work_rim += work - dot(row.impulse, mean);
  const double residual = contact::law_residual(row.impulse, row.after + Vec2{row.turning, 0.0},
                                                row.bounce, row.friction, mass) /
                          mass;
  report.residual = keep_larger(report.residual, residual);
  report.penetration = std::max(report.penetration, -row.gap);
  report.free_velocity = std::max(report.free_velocity, norm(row.free));
  if (row.kind != ContactKind::segment) report_on_ground(row, report);
  if (row.impulse.x > 0.0) {
    ++report.nodes;
    report.sticking += row.status == Status::stick ? 1 : 0;
    report.between_bodies += row.kind == ContactKind::segment ? 1 : 0;
    report.length += row.tributary;
  }
  add_active(row, state);
}

void GeneralContact::report_on_ground(const ContactRow& row, ContactReport& report) const {
  const auto& rows = row.rows;
  for (int i = 0; i < rows.count; ++i) {
    const Vec2 impulse = contact::transposed(rows.block[at(i)], row.impulse);
    report.impulse += impulse;
    report.angular_impulse += cross(finder_.positions()[at(rows.node[at(i)])] - center_, impulse);
  }
}

/// On each candidate of the row: the first node of a node's contact is pushed along the normal,
/// the nodes of a segment against it.
void GeneralContact::add_active(const ContactRow& row, State& state) const {
  for (int i = 0; i < row.rows.count; ++i) {
    const int candidate = candidate_[at(row.rows.node[at(i)])];
    if (candidate < 0) continue;
    const bool pushed = row.kind != ContactKind::corner && i == 0;
    ActiveContact a;
    a.candidate = at(candidate);
    a.normal = pushed ? row.normal : -row.normal;
    a.gap = row.gap;
    a.before = row.before;
    a.free = row.free;
    a.after = row.after;
    a.bounce = row.bounce;
    a.friction = row.friction;
    a.impulse = to_frame(a.normal, contact::transposed(row.rows.block[at(i)], row.impulse));
    a.status = row.status;
    a.on_ground = row.kind != ContactKind::segment;
    state.active.push_back(a);
  }
}

/// r_n/(Δt ℓ) of the step before, for a law that may need it                               [Pa]
double GeneralContact::pressure_before(const ContactRow& row) const {
  if (row.law->friction.is_constant() || row.tributary == 0.0) return 0.0;
  return coupled_.kept_of(row.key).x / (model_.dt * row.tributary);
}

void GeneralContact::keep_impulses() {
  coupled_.kept.clear();
  for (const ContactRow& row : rows_) coupled_.kept.emplace_back(row.key, row.impulse);
  coupled_.sort_kept();
}

}  // namespace rondo::dynamics
