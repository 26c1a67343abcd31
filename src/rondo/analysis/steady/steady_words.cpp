// SPDX-License-Identifier: BSD-3-Clause
/// What files, run.json and the user are told of a steady state.
#include <fmt/format.h>

#include <array>
#include <span>

#include "rondo/analysis/steady/steady_state.hpp"

namespace rondo::study {
namespace {

constexpr std::array plane_columns{
    Column<SteadySums>{"stick_length_m", "m",
                       "of the deformed boundary at the nodes that stick, summed",
                       [](const SteadySums& r) { return r.stick_length; }},
    Column<SteadySums>{"slip_length_m", "m", "of those that slip",
                       [](const SteadySums& r) { return r.slip_length; }},
    Column<SteadySums>{"pressure_max_pa", "Pa",
                       "largest of all contact nodes, over the deformed boundary as in contact.csv",
                       [](const SteadySums& r) { return r.pressure; }},
    Column<SteadySums>{"shear_max_pa", "Pa", "likewise",
                       [](const SteadySums& r) { return r.shear; }},
    Column<SteadySums>{"slip_speed_max", "m/s",
                       "likewise, by the slip that the law of friction sees",
                       [](const SteadySums& r) { return r.slip; }},
    Column<SteadySums>{"friction_power", "W/m", "taken by friction",
                       [](const SteadySums& r) { return r.friction; }},
};

constexpr std::array plane_pair_columns{
    Column<ContactRecord>{"slip_speed", "m/s",
                          "of the node over the ground, along x, as the law of friction sees it",
                          [](const ContactRecord& r) { return r.slip; }},
    Column<ContactRecord>{"sticks", "1", "1: it sticks; 0: it slips",
                          [](const ContactRecord& r) { return r.sticks ? 1.0 : 0.0; }},
};

Json json_of(const statics::RollingSlope& slope) {
  return {{"force_x", slope.forces.x},
          {"force_y", slope.forces.y},
          {"torque", slope.forces.torque},
          {"height", slope.height},
          {"speed", slope.speed}};
}

}  // namespace

void SteadyBody::add_columns(RecordPlan& plan) const {
  plan.columns = history_labels({});
  const std::vector<ColumnLabel> own =
      labels_of(std::span<const Column<SteadySums>>(plane_columns));
  plan.columns.insert(plan.columns.end(), own.begin(), own.end());
  plan.contact_columns = plane_pair_columns;
}

void SteadyState::append_row(int place, const Snapshot& now, std::vector<double>& rows) const {
  append_history({}, record(place, now), rows);
  append_values(std::span<const Column<SteadySums>>(plane_columns),
                sums_[static_cast<std::size_t>(place)], rows);
}

std::vector<std::string> SteadyState::notes() const {
  const statics::RollingForces& f = solution_.forces;
  return {
      fmt::format(
          "traction {:.6g} N/m, load {:.6g} N/m, torque {:.6g} N, rolling resistance {:.6g} N/m",
          f.x, f.y, torque(), resistance()),
      fmt::format("center {:.6g} m high at {:.6g} m/s, slip ratio {:.4g} %", height(),
                  solution_.speed, 100.0 * slip_ratio())};
}

Json SteadyState::describe() const {
  const statics::RollingSolution& s = solution_;
  const AnalysisCase& a = case_.analysis;
  const char* by_speed = a.torque ? "by_torque" : a.traction ? "by_traction" : "by_speed";
  Json j;
  j["force_x"] = s.forces.x;
  j["force_y"] = s.forces.y;
  j["torque"] = torque();
  j["height"] = height();
  j["speed"] = s.speed;
  j["slip_ratio"] = slip_ratio();
  j["rolling_resistance"] = resistance();
  j["stick_length"] = mean_.stick_length;
  j["slip_length"] = mean_.slip_length;
  j["pressure_max"] = mean_.pressure;
  j["shear_max"] = mean_.shear;
  j["slopes"] = {{"by_friction", json_of(s.slopes.by_friction)},
                 {a.load ? "by_load" : "by_height", json_of(s.slopes.by_height)},
                 {by_speed, json_of(s.slopes.by_speed)}};
  j["power"] = json_of(power_);
  j["scheme_share"] = power_.scheme_share;
  j["residual"] = s.residual;
  j["newton_steps"] = s.newton_steps;
  j["pivots"] = s.pivots;
  j["pairs"] = window_.pairs().size();
  j["samples_per_sector"] = window_.harmonics().body().samples;
  return j;
}

}  // namespace rondo::study
