// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/wheel_crush_record.hpp"

#include <algorithm>
#include <array>

#include "rondo/core/index.hpp"
#include "rondo/output/columns.hpp"

namespace rondo::study {
namespace {

using W = WheelCrushRow;
constexpr std::array wheel_columns{
    Column<W>{"depth_m", "m",
              "of the center below first touch; with `force_y` the curve of force over depth; the "
              "slide is `center_x_m`",
              [](const W& r) { return r.state.depth; }},
    Column<W>{"pressure_max_pa", "Pa",
              "largest of all contact nodes, over the deformed surface as in contact.csv",
              [](const W& r) { return r.sums.pressure; }},
    Column<W>{"shear_max_pa", "Pa", "likewise", [](const W& r) { return r.sums.shear; }},
    Column<W>{"contact_residual", "1", "of the contact law, from the whole field",
              [](const W& r) { return r.state.residual; }},
    Column<W>{"newton_steps", "1", "of the contact solver, in the increment",
              [](const W& r) { return static_cast<double>(r.state.solution.effort.newton_steps); }},
    Column<W>{"balance_residual", "1",
              "largest force by which a node is out of balance, over the load; 0 where the forces "
              "of the wheel are linear",
              [](const W& r) { return r.state.effort.residual; }},
    Column<W>{"contact_problems", "1",
              "problems of contact that were solved until the forces balanced; 0 where they are "
              "linear",
              [](const W& r) { return static_cast<double>(r.state.effort.turns); }},
};

HistoryRecord record_of(const W& r) {
  const statics::StandingState& s = r.state;
  const statics::RollingForces& f = s.solution.forces;
  HistoryRecord h;
  h.time = r.path.parameter(r.k);
  h.center = {s.slide, r.floor + s.solution.height, 0.0};
  h.force = {f.heading, f.normal, f.lateral};
  h.torque = f.torque;
  h.moment_aligning = f.aligning;
  h.moment_overturning = f.overturning;
  h.moments_iso =
      r.ground.about_contact_centre({f.aligning, f.overturning}, h.force, s.solution.height);
  h.nodes = r.sums.nodes;
  h.sticking = r.sums.sticking;
  h.contact_length = r.sums.area;
  h.footprint_length = r.sums.length;
  h.footprint_width = r.sums.width;
  h.penetration = s.penetration;
  const statics::CrushWorks& w = s.works;
  h.balance.strain = w.strain;
  h.balance.works.contact = w.contact;
  h.balance.works.dissipation_friction = w.friction;
  h.balance.works.loss_impact = w.impact;
  h.balance.works.rim = w.rim;
  h.balance.residual = w.residual;
  return h;
}

statics::NodeVector<3> force_of(const statics::StandingState& s, std::size_t pair) {
  return s.solution.force.segment<3>(static_cast<Eigen::Index>(3 * pair));
}

bool sticks(const statics::StandingState& s, std::size_t pair) {
  return s.solution.status[pair].status == contact::Status::stick;
}

}  // namespace

WheelCrushRecord::WheelCrushRecord(const mesh::Mesh& mesh, const statics::StandingWheel& wheel)
    : wheel_(wheel), boundary_(mesh), candidate_of_node_(mesh.n_nodes()) {
  for (std::size_t k = 0; k < mesh.boundary.size(); ++k)
    candidate_of_node_[at(mesh.boundary[k])] = k;
}

std::size_t WheelCrushRecord::candidate_of(std::size_t pair) const {
  const statics::RollingHarmonics<3>& h = wheel_.window().harmonics();
  const statics::RollingPair& p = wheel_.window().pairs()[pair];
  const auto row = at(h.body().candidates[p.candidate]);
  return candidate_of_node_[h.body().stiffness.node(row, h.wrapped(p.sample))];
}

WheelCrushSums WheelCrushRecord::sum_up(const GroundFrame& ground) const {
  const statics::StandingState& state = wheel_.state();
  const Field u(state.nodes);
  mesh::Footprint footprint(ground, rotation(0.0));
  WheelCrushSums s;
  for (std::size_t j = 0; j < state.solution.status.size(); ++j) {
    const statics::NodeVector<3> r = force_of(state, j);
    if (!(r[0] > 0.0)) continue;
    const double area = boundary_.extent(candidate_of(j), u);
    boundary_.widen(candidate_of(j), u, footprint);
    ++s.nodes;
    s.sticking += sticks(state, j) ? 1 : 0;
    s.area += area;
    s.pressure = std::max(s.pressure, r[0] / area);
    s.shear = std::max(s.shear, r.tail<2>().norm() / area);
  }
  s.length = footprint.length();
  s.width = footprint.width();
  return s;
}

void WheelCrushRecord::fill(const WheelCrushRow& r, const std::vector<Vec3>& before,
                            Snapshot& s) const {
  const statics::StandingState& state = r.state;
  const double increments = r.path.increments_of_parameter();
  s.time = r.path.parameter(r.k);
  s.time_velocity = r.path.parameter(r.k - 0.5);
  s.center = {state.slide, r.floor + state.solution.height, 0.0};
  std::vector<Vec3> rate(before.size());
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = increments * (state.nodes[i] - before[i]);
  s.u = state.nodes;
  s.v = rate;
  s.contacts.clear();
  constexpr Vec2 normal{0.0, 1.0};  // along t1 and n
  const statics::NodeMatrix<3> axes = statics::ground_axes<3>(wheel_.window().problem().lean);
  for (std::size_t j = 0; j < state.solution.status.size(); ++j) {
    const statics::NodeVector<3> force = force_of(state, j);
    if (!(force[0] > 0.0)) continue;
    s.contacts.push_back({.candidate = candidate_of(j),
                          .force = {to_frame(normal, Vec2{force[1], force[0]}), force[2]},
                          .force_fixed = statics::vec_of(statics::NodeVector<3>(axes * force)),
                          .sticks = sticks(state, j)});
  }
  std::ranges::sort(s.contacts, {}, &ContactForce::candidate);
  const statics::RollingForces& f = state.solution.forces;
  s.series = {state.depth, f.normal, f.heading, f.lateral, r.sums.area, r.sums.pressure};
}

std::vector<ColumnLabel> wheel_crush_columns() {
  std::vector<ColumnLabel> columns = history_labels({.solid = true});
  for (ColumnLabel& label : labels_of(std::span<const Column<W>>(wheel_columns)))
    columns.push_back(std::move(label));
  columns.front().unit.assign(1, '1');
  return columns;
}

void append_row(const WheelCrushRow& row, std::vector<double>& rows) {
  append_history({.solid = true}, record_of(row), rows);
  append_values(std::span<const Column<W>>(wheel_columns), row, rows);
}

std::vector<io::Series> wheel_crush_series() {
  return {
      {"/crush/depth", "m", "depth of the center below first touch"},
      {"/crush/force", "N",
       "force of the ground on the wheel: normal, along the heading t1, to the right along t2", 3},
      {"/crush/contact_area", "m2", "area of the deformed surface in contact"},
      {"/crush/pressure_max", "Pa",
       "largest pressure of all contact nodes, over the deformed surface"}};
}

}  // namespace rondo::study
