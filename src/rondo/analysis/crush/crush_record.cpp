// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/crush_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/output/columns.hpp"

namespace rondo::study {
namespace {

constexpr Vec2 normal{0.0, 1.0};  ///< a contact frame's vector times it is along the fixed axes

using R = CrushRecord;
constexpr std::array own_columns{
    Column<R>{"depth_m", "m",
              "of the center below first touch; with `force_y` the curve of force over depth; the "
              "slide is `center_x_m`",
              [](const R& r) { return r.state.depth; }},
    Column<R>{"pressure_max_pa", "Pa",
              "largest of all contact nodes, over the deformed boundary as in contact.csv",
              [](const R& r) { return r.sums.pressure; }},
    Column<R>{"shear_max_pa", "Pa", "likewise", [](const R& r) { return r.sums.shear; }},
    Column<R>{"contact_residual", "1", "of the contact law, from the whole field",
              [](const R& r) { return r.report.residual; }},
    Column<R>{"sweeps", "1", "of the contact solver",
              [](const R& r) { return static_cast<double>(r.report.sweeps); }},
};

HistoryRecord record_of(const CrushSetup& setup, const CrushRecord& r) {
  HistoryRecord h;
  h.time = setup.path.parameter(r.k);
  h.center = setup.center(r.state);
  h.force = r.sums.force;
  h.torque = r.sums.torque;
  h.nodes = r.sums.nodes;
  h.sticking = r.sums.sticking;
  h.contact_length = r.sums.length;
  h.penetration = r.report.penetration;
  const statics::CrushWorks& w = r.state.works;
  h.balance.strain = w.strain;
  h.balance.works.contact = w.contact;
  h.balance.works.dissipation_friction = w.friction;
  h.balance.works.loss_impact = w.impact;
  h.balance.works.rim = w.rim;
  h.balance.residual = w.residual;
  return h;
}

/// The rest of a force that LATIN leaves on an open node is no contact.
bool touches(const statics::CrushState& state, std::size_t k) {
  return state.force[k].x > 0.0 && state.status[k] != contact::Status::open;
}

}  // namespace

CrushSums sum_up(const CrushSetup& setup, const mesh::DeformedBoundary& boundary,
                 const statics::CrushState& state) {
  CrushSums s;
  for (std::size_t k = 0; k < state.force.size(); ++k) {
    const Vec2 r = state.force[k];
    if (!touches(state, k)) continue;
    const auto node = static_cast<std::size_t>(setup.model.nodes[k]);
    const double length = boundary.extent(k, state.u);
    s.contact += r;
    s.force += from_frame(normal, r);
    s.torque += cross(setup.mesh.coordinates[node] + state.u[node], from_frame(normal, r));
    ++s.nodes;
    s.sticking += state.status[k] == contact::Status::stick ? 1 : 0;
    s.length += length;
    s.pressure = std::max(s.pressure, r.x / length);
    s.shear = std::max(s.shear, std::abs(r.y) / length);
  }
  return s;
}

std::vector<ColumnLabel> crush_columns() {
  std::vector<ColumnLabel> columns = history_labels({});
  const std::vector<ColumnLabel> own = labels_of(std::span<const Column<R>>(own_columns));
  columns.insert(columns.end(), own.begin(), own.end());
  columns.front().unit.assign(1, '1');
  return columns;
}

void append_row(const CrushSetup& setup, const CrushRecord& r, std::vector<double>& rows) {
  append_history({}, record_of(setup, r), rows);
  append_values(std::span<const Column<R>>(own_columns), r, rows);
}

io::ResultsWords crush_words(const CrushPath& path) {
  const std::string share = path.is_of_tables() ? "share of the increments" : "share of the depth";
  return {.analysis = "crush",
          .time_unit = "1",
          .time = share + (path.is_of_tables() ? "" : ", above 1 while the body slides") +
                  ", of displacement, center, contact and fields; NaN: snapshot not written",
          .velocity_time = "of velocity: half an increment before /frame/time",
          .velocity_unit = "m",
          .velocity = "rate of the displacement over the " + share + ", at /frame/time_velocity",
          .field_velocity = "rate of the displacement of each node over the " + share +
                            ", along the fixed axes, at /frame/time_velocity",
          .force = "of the equilibrium at /frame/time"};
}

std::vector<io::Series> crush_series() {
  return {{"/crush/depth", "m", "depth of the center below first touch"},
          {"/crush/force", "N/m", "force of the ground on the body: normal, tangential", 2},
          {"/crush/contact_length", "m", "length of the deformed boundary in contact"},
          {"/crush/pressure_max", "Pa",
           "largest pressure of all contact nodes, over the deformed boundary"}};
}

void fill(const CrushSetup& setup, const CrushRecord& r, const std::vector<Vec2>& before,
          Snapshot& s) {
  const statics::CrushState& state = r.state;
  const double increments = setup.path.increments_of_parameter();
  s.time = setup.path.parameter(r.k);
  s.time_velocity = setup.path.parameter(r.k - 0.5);
  s.center = setup.center(state);
  s.u = state.u;
  s.v = state.u;
  for (std::size_t i = 0; i < before.size(); ++i)
    s.v.plane()[i] = increments * (state.u[i] - before[i]);
  s.contacts.clear();
  for (std::size_t k = 0; k < state.force.size(); ++k)
    if (touches(state, k))
      s.contacts.push_back({.candidate = k,
                            .force = state.force[k],
                            .force_fixed = from_frame(normal, state.force[k])});
  s.series = {state.depth, r.sums.contact.x, r.sums.contact.y, r.sums.length, r.sums.pressure};
}

}  // namespace rondo::study
