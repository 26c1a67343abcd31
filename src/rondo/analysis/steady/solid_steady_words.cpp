// SPDX-License-Identifier: BSD-3-Clause
/// What files, run.json and the user are told of a steady state in three dimensions.
#include <fmt/format.h>

#include <array>
#include <span>

#include "rondo/analysis/steady/solid_steady_state.hpp"

namespace rondo::study {
namespace {

using R = SolidSteadySums;
constexpr std::array own_columns{
    Column<R>{"stick_area_m2", "m2", "of the deformed surface at the nodes that stick, summed",
              [](const R& r) { return r.stick_area; }},
    Column<R>{"slip_area_m2", "m2", "of those that slip", [](const R& r) { return r.slip_area; }},
    Column<R>{"pressure_max_pa", "Pa",
              "largest of all contact nodes, over the deformed boundary as in contact.csv",
              [](const R& r) { return r.pressure; }},
    Column<R>{"shear_max_pa", "Pa", "likewise", [](const R& r) { return r.shear; }},
    Column<R>{"slip_speed_max", "m/s", "likewise, by the slip that the law of friction sees",
              [](const R& r) { return r.slip; }},
    Column<R>{"friction_power", "W", "taken by friction", [](const R& r) { return r.friction; }},
};

using P = ContactRecord;
constexpr std::array pair_columns{
    Column<P>{"slip_speed", "m/s", "of the node over the ground, as the law of friction sees it",
              [](const P& r) { return r.slip; }},
};

Json json_of(const statics::SolidRollingSlope& slope) {
  const statics::SolidRollingForces& f = slope.forces;
  return {{"force_x", f.heading},          {"force_y", f.normal},
          {"force_lateral", f.lateral},    {"torque", f.torque},
          {"moment_aligning", f.aligning}, {"moment_overturning", f.overturning},
          {"height", slope.height},        {"speed", slope.speed}};
}

}  // namespace

void SolidSteadyBody::add_columns(RecordPlan& plan) const {
  plan.columns = history_labels({.solid = true});
  for (ColumnLabel& label : labels_of(std::span<const Column<R>>(own_columns)))
    plan.columns.push_back(std::move(label));
  plan.contact_columns = pair_columns;
}

void SolidSteadyState::append_row(int place, const Snapshot& now, std::vector<double>& rows) const {
  append_history({.solid = true}, record(place, now), rows);
  append_values(std::span<const Column<R>>(own_columns), sums_[static_cast<std::size_t>(place)],
                rows);
}

std::vector<std::string> SolidSteadyState::notes() const {
  const statics::SolidRollingForces& f = solution_.forces;
  return {fmt::format("traction {:.6g} N, load {:.6g} N, lateral force {:.6g} N, aligning moment "
                      "{:.6g} N m, torque {:.6g} N m, rolling resistance {:.6g} N",
                      f.heading, f.normal, f.lateral, f.aligning, torque(), resistance()),
          fmt::format("center {:.6g} m high at {:.6g} m/s, slip ratio {:.4g} %, slip angle {:.4g} "
                      "rad, camber {:.4g} rad",
                      height(), solution_.speed, 100.0 * slip_ratio(), drive_.slip_angle,
                      case_.motion.camber)};
}

Json SolidSteadyState::describe() const {
  const statics::SolidRollingSolution& s = solution_;
  const AnalysisCase& a = case_.analysis;
  const char* by_speed = a.torque ? "by_torque" : a.traction ? "by_traction" : "by_speed";
  Json j;
  j["force_x"] = s.forces.heading;
  j["force_y"] = s.forces.normal;
  j["force_lateral"] = s.forces.lateral;
  j["torque"] = torque();
  j["moment_aligning"] = s.forces.aligning;
  j["moment_overturning"] = s.forces.overturning;
  j["height"] = height();
  j["speed"] = s.speed;
  j["slip_ratio"] = slip_ratio();
  j["slip_angle"] = drive_.slip_angle;
  j["camber"] = case_.motion.camber;
  j["rolling_resistance"] = resistance();
  j["stick_area"] = mean_.stick_area;
  j["slip_area"] = mean_.slip_area;
  j["pressure_max"] = mean_.pressure;
  j["shear_max"] = mean_.shear;
  j["slopes"] = {{"by_friction", json_of(s.slopes.by_friction)},
                 {a.load ? "by_load" : "by_height", json_of(s.slopes.by_height)},
                 {by_speed, json_of(s.slopes.by_speed)},
                 {"by_slip_angle", json_of(s.slopes.by_slip_angle)}};
  j["power"] = json_of(power_);
  j["scheme_share"] = power_.scheme_share;
  j["residual"] = s.residual;
  j["newton_steps"] = s.newton_steps;
  j["sweeps"] = s.sweeps;
  j["pairs"] = window_.pairs().size();
  j["samples_per_sector"] = window_.harmonics().body().samples;
  return j;
}

}  // namespace rondo::study
