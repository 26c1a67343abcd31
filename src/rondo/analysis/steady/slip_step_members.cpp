// SPDX-License-Identifier: BSD-3-Clause
/// What files, run.json and the user are told of a step of the slip.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "rondo/analysis/steady/relaxation.hpp"
#include "rondo/analysis/steady/slip_step.hpp"
#include "rondo/core/column.hpp"

namespace rondo::study {
namespace {

using Row = SlipStepRow;
constexpr std::array step_columns{
    Column<Row>{"distance_m", "m", "rolled since the step",
                [](const Row& r) { return r.distance; }},
    Column<Row>{"force_x", "N", "of the ground on the wheel along its heading",
                [](const Row& r) { return r.forces.heading; }},
    Column<Row>{"force_y", "N", "along the normal of the ground",
                [](const Row& r) { return r.forces.normal; }},
    Column<Row>{"force_lateral", "N", "to the right of the heading",
                [](const Row& r) { return r.forces.lateral; }},
    Column<Row>{"torque", "N·m", "on the rim, clockwise",
                [](const Row& r) { return r.forces.torque; }},
    Column<Row>{"moment_aligning", "N·m", "of the ground on the wheel about the normal",
                [](const Row& r) { return r.forces.aligning; }},
    Column<Row>{"moment_overturning", "N·m", "about the heading, in the ground below the center",
                [](const Row& r) { return r.forces.overturning; }},
    Column<Row>{"height_m", "m", "of the center above the ground",
                [](const Row& r) { return r.height; }},
    Column<Row>{"speed", "m/s", "of the center", [](const Row& r) { return r.speed; }},
    Column<Row>{"slip_ratio", "1", "as in history.csv", [](const Row& r) { return r.slip_ratio; }},
    Column<Row>{"slip_angle", "rad", "as in history.csv",
                [](const Row& r) { return r.slip_angle; }},
};

/// Changes that are smaller parts of the load, times the radius where they are moments, are none.
constexpr double least_change = 1e-6;

using Force = double statics::RollingForces::*;
Relaxation relaxation_in(const SlipStep& step, Force of) {
  std::vector<double> distance, force;
  for (const Row& r : step.rows) {
    distance.push_back(r.distance);
    force.push_back(r.forces.*of);
  }
  const double arm = of == &statics::RollingForces::aligning ? step.radius : 1.0;
  return relaxation_of(distance, force, step.after.forces.*of,
                       least_change * step.rows[0].forces.normal * arm);
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

constexpr JsonMember<Relaxation> relaxation_rows[] = {
    {"before", "number", "", "Value before the step",
     [](const Relaxation& r) -> Json { return r.before; }},
    {"after", "number", "", "Value of steady rolling after the step, solved directly",
     [](const Relaxation& r) -> Json { return r.after; }},
    {"share", "number", "", "Share of this change that is reached at the end of the distance",
     [](const Relaxation& r) -> Json { return r.share; }},
    {"relaxation_length", "number", "m",
     "Relaxation length: distance at which 1 - 1/e, 63.2 %, of the change is reached; null: it is "
     "not reached, or there is no change",
     [](const Relaxation& r) { return number_or_null(r.length); }},
    {"fitted_length", "number", "m",
     "Relaxation length σ of 1 - exp(-s/σ), by least squares over the distance; null: there is no "
     "change, or the distance is too short to tell it",
     [](const Relaxation& r) { return number_or_null(r.fitted); }},
    {"fit_error", "number", "",
     "Root mean square error of that curve, over the change; null: likewise",
     [](const Relaxation& r) { return number_or_null(r.fit_error); }},
};

struct Stepped {
  const Case& c;
  const SlipStep& step;
};
Json relaxation_json(const Stepped& t, Force of, bool is_of_it) {
  return is_of_it ? object_of(relaxation_rows, relaxation_in(t.step, of)) : absent();
}
std::vector<MemberText> relaxation_texts() {
  return texts_of(relaxation_rows);
}
bool turns(const Case& c) noexcept {
  return c.analysis.slip_angle_step.has_value();
}
constexpr JsonMember<Stepped> step_rows[] = {
    {"distance", "number", "m", "Distance that was rolled after the step",
     [](const Stepped& t) -> Json { return t.step.rows.back().distance; }},
    {"steps", "integer", "", "Steps of that distance, one for each sample of the turn",
     [](const Stepped& t) -> Json { return t.step.rows.size() - 1; }},
    {"residual", "number", "", "Largest residual of the contact law, over the largest force",
     [](const Stepped& t) -> Json { return t.step.residual; }},
    {"force_lateral", "object", "", "After a step of the slip angle, in N",
     [](const Stepped& t) {
       return relaxation_json(t, &statics::RollingForces::lateral, turns(t.c));
     },
     relaxation_texts},
    {"moment_aligning", "object", "", "After a step of the slip angle, in N·m",
     [](const Stepped& t) {
       return relaxation_json(t, &statics::RollingForces::aligning, turns(t.c));
     },
     relaxation_texts},
    {"force_x", "object", "", "After a step of the slip ratio, in N",
     [](const Stepped& t) {
       return relaxation_json(t, &statics::RollingForces::heading, !turns(t.c));
     },
     relaxation_texts},
};
constexpr JsonMember<Stepped> all_rows[] = {
    {"slip_step", "object", "",
     "How a 3D wheel follows a step of its slip over the rolled distance",
     [](const Stepped& t) { return object_of(step_rows, t); }, [] { return texts_of(step_rows); }},
};

/// The force that follows the step first of all.
Relaxation leading(const Case& c, const SlipStep& step) {
  return relaxation_in(
      step, turns(c) ? &statics::RollingForces::lateral : &statics::RollingForces::heading);
}

/// Friction that falls with the slip speed has several states for the same slip.
std::string_view other_states(const Case& c) {
  if (!contact::falls_with_slip(c.ground->friction)) return "";
  return "; where friction falls with the slip speed the wheel may come to another state than that "
         "of the change, and its relaxation length is then that of neither";
}

/// Warns of a change that is not reached on the way.
void add_short_distance(const Case& c, const SlipStep& step, std::string_view name,
                        const Relaxation& r, std::vector<std::string>& warnings) {
  constexpr double enough = 0.95;
  if (!r.changes || r.share >= enough) return;
  warnings.push_back(fmt::format(
      "analysis.step_distance = {:.4g} m: only {:.3g} % of the change of the {} is reached after "
      "{:.4g} m, and {}; a longer distance{}",
      *c.analysis.step_distance, 100.0 * r.share, name, step.rows.back().distance,
      r.fitted ? "the exponential is fitted to a part" : "no exponential is fitted",
      other_states(c)));
}

}  // namespace

io::CsvPlace write_slip_step(const SlipStep& step, const std::filesystem::path& directory) {
  const std::span<const Column<Row>> columns(step_columns);
  io::Csv file(directory / "slip-step.csv", names_of(slip_step_labels()));
  std::vector<double> values;
  for (const Row& row : step.rows) append_values(columns, row, values);
  file.rows(values);
  const io::CsvPlace place = file.place();
  file.close();
  return place;
}

void add_slip_step(const Case& c, const SlipStep& step, Json& json) {
  add_members(all_rows, {c, step}, json);
}

std::vector<std::string> notes_of(const Case& c, const SlipStep& step) {
  const Relaxation r = leading(c, step);
  if (!r.changes) return {};
  return {fmt::format(
      "step of the slip {}: from {:.5g} N to {:.5g} N, relaxation length {}, of an exponential "
      "{}; {:.3g} % of it after {:.4g} m",
      turns(c) ? "angle, lateral force" : "ratio, traction", r.before, r.after,
      r.length ? fmt::format("{:.4g} m", *r.length) : "not reached",
      r.fitted ? fmt::format("{:.4g} m", *r.fitted) : "none", 100.0 * r.share,
      step.rows.back().distance)};
}

std::vector<std::string> warnings_of(const Case& c, const SlipStep& step) {
  constexpr double most_sliding = 0.5;
  const std::string key(turns(c) ? "analysis.slip_angle_step" : "analysis.slip_ratio_step");
  const Relaxation r = leading(c, step);
  if (!r.changes)
    return {
        fmt::format("{}: the step changes the force by less than {:.0e} of the load, and there "
                    "is no relaxation length",
                    key, least_change)};
  std::vector<std::string> all;
  add_short_distance(c, step, turns(c) ? "lateral force" : "traction", r, all);
  if (turns(c))
    add_short_distance(c, step, "aligning moment",
                       relaxation_in(step, &statics::RollingForces::aligning), all);
  if (step.sliding > most_sliding)
    all.push_back(fmt::format(
        "{}: after the step {:.3g} % of the load is where the wheel slides, and the relaxation "
        "length is shorter than that of small slips; a smaller step",
        key, 100.0 * step.sliding));
  return all;
}

std::vector<ColumnLabel> slip_step_labels() {
  return labels_of(std::span<const Column<Row>>(step_columns));
}

std::vector<MemberText> slip_step_members() {
  return texts_of(all_rows);
}

}  // namespace rondo::study
