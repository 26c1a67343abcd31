// SPDX-License-Identifier: BSD-3-Clause
/// What files, run.json and the user are told of a steady state.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "rondo/analysis/steady/steady_members.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

using R = SteadySums;
template <int D>
constexpr std::array own_columns{
    Column<R>{D == 2 ? "stick_length_m" : "stick_area_m2", D == 2 ? "m" : "m2",
              D == 2 ? "of the deformed boundary at the nodes that stick, summed"
                     : "of the deformed surface at the nodes that stick, summed",
              [](const R& r) { return r.stick; }},
    Column<R>{D == 2 ? "slip_length_m" : "slip_area_m2", D == 2 ? "m" : "m2", "of those that slip",
              [](const R& r) { return r.slip; }},
    Column<R>{"pressure_max_pa", "Pa",
              "largest of all contact nodes, over the deformed boundary as in contact.csv",
              [](const R& r) { return r.pressure; }},
    Column<R>{"shear_max_pa", "Pa", "likewise", [](const R& r) { return r.shear; }},
    Column<R>{"slip_speed_max", "m/s", "likewise, by the slip that the law of friction sees",
              [](const R& r) { return r.speed; }},
    Column<R>{"friction_power", D == 2 ? "W/m" : "W", "taken by friction",
              [](const R& r) { return r.friction; }},
};

using P = ContactRecord;
constexpr std::array plane_pair_columns{
    Column<P>{"slip_speed", "m/s",
              "of the node over the ground, along x, as the law of friction sees it",
              [](const P& r) { return r.slip; }},
    Column<P>{"sticks", "1", "1: it sticks; 0: it slips",
              [](const P& r) { return r.sticks ? 1.0 : 0.0; }},
};
constexpr std::array solid_pair_columns{
    Column<P>{"slip_speed", "m/s", "of the node over the ground, as the law of friction sees it",
              [](const P& r) { return r.slip; }},
};

}  // namespace

template <int D>
void SteadyBody<D>::add_columns(RecordPlan& plan) const {
  plan.columns = history_labels({.solid = D == 3});
  for (ColumnLabel& label : labels_of(std::span<const Column<R>>(own_columns<D>)))
    plan.columns.push_back(std::move(label));
  static const std::array plane{plane_pair_columns[0], plane_pair_columns[1], friction_column()};
  static const std::array solid{solid_pair_columns[0], friction_column()};
  plan.contact_columns = D == 2 ? std::span<const Column<P>>(plane) : solid;
}

template <int D>
void SteadyState<D>::append_row(int place, const Snapshot& now, std::vector<double>& rows) const {
  append_history({.solid = D == 3}, record(place, now), rows);
  append_values(std::span<const Column<R>>(own_columns<D>), sums_[at(place)], rows);
}

template <int D>
std::string SteadyState<D>::nothing_touches() const {
  if (D == 2)
    return fmt::format(
        "less than the outer radius as deformed by the spin, about {:.6g} m above "
        "the ground",
        body_.radius);
  return fmt::format(
      "less than {:.6g} m above the ground, the lowest place of the wheel as the "
      "spin deforms it",
      window_.lowest());
}

template <int D>
std::string SteadyState<D>::why_it_slides() const {
  if (drive_.friction == 0.0)
    return "motion.speed instead, because without friction no traction determines it; or "
           "ground.friction above 0";
  const double asked = case_.analysis.torque.value_or(case_.analysis.traction.value_or(1.0));
  if (asked == 0.0 && drive_.slip_angle == 0.0)
    return "more analysis.samples_per_sector, because a wheel that rolls freely slides as a whole "
           "only where the search for its speed fails; or motion.speed instead";
  if (D == 3)
    return "nearer to 0, or a smaller motion.slip_angle, because both share the friction; or "
           "motion.speed instead";
  return fmt::format("nearer to 0, below {} = {:.6g} times the load{}; or motion.speed instead",
                     law_ ? "ground.friction.coefficient" : "ground.friction", drive_.friction,
                     case_.analysis.torque ? " times the height" : "");
}

template <int D>
std::string SteadyState<D>::friction_not_found() const {
  const statics::FrictionEffort& f = solution_.friction;
  const std::size_t pair = f.pair;
  const double extent = law_->extent[window_.pairs()[pair].candidate];
  const Where w = where(pair);
  const AnalysisCase& a = case_.analysis;
  const std::string fewer =
      a.samples_per_sector > 1
          ? fmt::format("fewer analysis.samples_per_sector than {}", a.samples_per_sector)
          : std::string("another number of sectors");
  return fmt::format(
      "ground.friction: no state was found whose coefficients are those of its slip speeds and "
      "pressures: {:.4g} of the way from the constant coefficient to the table were reached, in {} "
      "problems of contact and {} restarts; beyond, a coefficient still changes by {:.2g} (bound "
      "{:.0e}), at contact node {} at sample {}, which slides at {:.4g} m/s under {:.4g} Pa; {}{}, "
      "a ground.friction.slip_speed that falls less steeply{}",
      f.share, f.problems, f.restarts, f.change, statics::coefficient_bound,
      body_.mesh.boundary[w.candidate], w.place, std::abs(slip(pair)), force(pair)[0] / extent,
      fewer, a.slip == RollingSlip::bdf2 ? ", analysis.slip = \"upwind\"" : "",
      a.traction || a.torque
          ? "; or motion.speed instead, because friction that falls may not carry the force"
          : "; or a dynamic analysis");
}

/// In space, where pairs may be too many for the work on them, what makes fewer comes first.
template <int D>
std::string SteadyState<D>::not_solved() const {
  const AnalysisCase& a = case_.analysis;
  const statics::RollingEffort& effort = solution_.effort;
  if (law_ && !solution_.friction.solved) return friction_not_found();
  if (finite_ && finite_->effort.turns > 1)
    return fmt::format(
        "the nonlinear forces (inflation.nonlinear) were not balanced: {} problems of contact "
        "leave {:.2g} of the load (bound {:.0e}); {}a smaller analysis.load or less deflection, "
        "fewer analysis.samples_per_sector, a smaller ground.friction, or inflation.nonlinear = "
        "\"none\"",
        finite_->effort.turns, finite_->effort.residual, statics::finite_rolling_bound,
        drive_.friction > 0.0 ? "ground.friction = 0 for the load alone, " : "");
  const bool too_many = D == 3 && effort.spent();
  std::string found = "the iteration over sets of contacts did not end", remedy;
  if (too_many)
    found = fmt::format(
        "analysis.samples_per_sector = {} makes {} pairs of a node and a sample near the ground, "
        "and {:.2g} operations (limit {:.2g}) did not solve them",
        a.samples_per_sector, window_.pairs().size(), effort.work, effort.most);
  else if (std::isfinite(solution_.residual))
    found = fmt::format("residual {:.3g}, bound {:.0e}", solution_.residual,
                        statics::rolling_residual_bound);
  if (too_many)
    remedy = fmt::format("{}a coarser {}{}", a.samples_per_sector > 1 ? "fewer samples, " : "",
                         case_.section ? "section.file or fewer section.sectors" : "disk.mesh",
                         a.load ? "" : ", a larger motion.height");
  else if (D == 3)
    remedy = "another analysis.samples_per_sector (1 to 8, fewer first)";
  else
    remedy = fmt::format("another analysis.samples_per_sector (4 to 32{})",
                         window_.time() < case_.damping.stiffness
                             ? fmt::format("; fewer, as a sample of {:.2g} s is shorter than "
                                           "damping.stiffness",
                                           window_.time())
                             : "");
  const std::string_view massless = a.massless_contact ? "" : ", analysis.massless_contact = true";
  const std::string_view slip = a.slip == RollingSlip::bdf2 ? ", analysis.slip = \"upwind\"" : "";
  return fmt::format(
      "the contact was not solved: {}, after {} Newton steps and {} {}; {}{}{}{} a smaller "
      "ground.friction{}",
      found, effort.newton_steps, D == 2 ? effort.pivots : effort.sweeps,
      D == 2 ? "pivots" : "sweeps", remedy, massless, slip, D == 2 ? " or both," : ",",
      a.load ? " or analysis.load" : "");
}

/// At a slip angle or in a turn what is lost is the drag of cornering as well.
template <int D>
std::string SteadyState<D>::resistance_note() const {
  if (solution_.speed == 0.0) return {};
  const double per_speed = 1.0 / std::abs(solution_.speed);
  const bool is_straight = drive_.slip_angle == 0.0 && drive_.turn_slip == 0.0;
  return fmt::format(
      "{} {:.6g} {}: material {:.4g}, mass damping {:.4g}, stiffness damping {:.4g}, "
      "friction {:.4g}, scheme {:.2g}",
      is_straight ? "rolling resistance" : "power lost over speed", resistance(),
      D == 2 ? "N/m" : "N", power_.viscosity * per_speed, power_.mass * per_speed,
      power_.stiffness * per_speed, power_.friction * per_speed, -power_.scheme * per_speed);
}

template <int D>
std::vector<std::string> SteadyState<D>::notes() const {
  const statics::RollingForces& f = solution_.forces;
  const std::string place = fmt::format("center {:.6g} m high at {:.6g} m/s, slip ratio {:.4g} %",
                                        height(), solution_.speed, 100.0 * slip_ratio());
  std::vector<std::string> notes;
  if (D == 2) {
    notes = {fmt::format("traction {:.6g} N/m, load {:.6g} N/m, torque {:.6g} N", f.heading,
                         f.normal, torque()),
             place};
  } else {
    notes = {fmt::format("traction {:.6g} N, load {:.6g} N, lateral force {:.6g} N, aligning "
                         "moment {:.6g} N m, torque {:.6g} N m",
                         f.heading, f.normal, f.lateral, f.aligning, torque()),
             fmt::format("{}, slip angle {:.4g} rad, camber {:.4g} rad{}", place, drive_.slip_angle,
                         case_.motion.camber,
                         drive_.turn_slip != 0.0
                             ? fmt::format(", turn slip {:.4g} 1/m", drive_.turn_slip)
                             : std::string())};
  }
  if (std::string lost = resistance_note(); !lost.empty()) notes.push_back(std::move(lost));
  if (slip_step_)
    for (std::string& note : notes_of(case_, *slip_step_)) notes.push_back(std::move(note));
  return notes;
}

template <int D>
void SteadyState<D>::describe(Json& json) const {
  std::vector<std::string> parts;
  for (const auto& part : body_.viscous) parts.push_back(part.name);
  add_steady({case_, solution_, mean_, power_, parts, slip_error_, height(), slip_ratio(),
              resistance(), window_.pairs().size(), D == 3, finite_ ? &finite_->effort : nullptr},
             json);
  if (slip_step_) add_slip_step(case_, *slip_step_, json);
}

template void SteadyBody<2>::add_columns(RecordPlan&) const;
template void SteadyState<2>::append_row(int, const Snapshot&, std::vector<double>&) const;
template std::string SteadyState<2>::nothing_touches() const;
template std::string SteadyState<2>::why_it_slides() const;
template std::string SteadyState<2>::friction_not_found() const;
template std::string SteadyState<2>::not_solved() const;
template std::string SteadyState<2>::resistance_note() const;
template std::vector<std::string> SteadyState<2>::notes() const;
template void SteadyState<2>::describe(Json&) const;
template void SteadyBody<3>::add_columns(RecordPlan&) const;
template void SteadyState<3>::append_row(int, const Snapshot&, std::vector<double>&) const;
template std::string SteadyState<3>::nothing_touches() const;
template std::string SteadyState<3>::why_it_slides() const;
template std::string SteadyState<3>::friction_not_found() const;
template std::string SteadyState<3>::not_solved() const;
template std::string SteadyState<3>::resistance_note() const;
template std::vector<std::string> SteadyState<3>::notes() const;
template void SteadyState<3>::describe(Json&) const;

}  // namespace rondo::study
