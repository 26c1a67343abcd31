// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/tyre/pressed_tyre.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "rondo/analysis/build/plausible/plausible.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

/// Rounded to two digits, for what is estimated.
double two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * std::round(value / unit);
}

/// The air cannot bear the load, or does not feel it; empty: tyres bear such loads.
std::string unusual_load(const std::string& key, double load, const InflationFigures& state) {
  const double air = air_force(state), share = load / air;
  if (share >= least_air_share && share <= most_air_share) return {};
  return fmt::format(
      "{}: the load of {:.6g} N is {:.2g} times the {:.5g} N of pressure times width times radius "
      "of the inflated wheel, and tyres bear 0.05 to 0.7 of that: {}; is the load in N, and "
      "inflation.pressure in Pa?",
      key, load, share, air, share > 1.0 ? "the air cannot bear it" : "it hardly presses the tyre");
}

/// The rim comes too near to the ground; empty: it does not. @param found "", or "about "
std::string deeply_pressed(const std::string& key, double deflection, const Wall& wall,
                           const char* found, const char* instead) {
  const double share = deflection / wall.thickness;
  if (share <= deep_tyre_share) return {};
  return fmt::format(
      "{}: the rim comes down by {}{:.4g} m, {:.3g} % of the {:.4g} m of the wall, and tyres bear "
      "their load at 10 to {:.0f} %; linear forces (inflation.nonlinear = \"none\") are far too "
      "stiff "
      "there: give {}",
      key, found, deflection, 100.0 * share, wall.thickness, 100.0 * deep_tyre_share, instead);
}

std::string of_wall(double deflection, const Wall& wall) {
  return fmt::format("{:.4g} m, {:.3g} % of the {:.4g} m of the wall", deflection,
                     100.0 * deflection / wall.thickness, wall.thickness);
}

void add(std::string warning, PhysicalFigures& to) {
  if (!warning.empty()) to.warnings.push_back(std::move(warning));
}

}  // namespace

double air_force(const InflationFigures& state) {
  return state.pressure * state.width * state.outer_radius;
}

/// (T.4) of docs/tyre.md. Flat ground, a depth d inside a torus of width w and outer diameter D,
/// cuts it in an ellipse with the half axes sqrt(D d) and sqrt(w d): the load is p π d sqrt(w D).
double air_stiffness(const InflationFigures& state) {
  return std::numbers::pi * state.pressure * std::sqrt(2.0 * state.width * state.outer_radius);
}

PhysicalFigures under_load(const std::string& key, double load, const PressedTyre& tyre) {
  RONDO_DEMAND(load > 0.0 && air_force(tyre.state) > 0.0, load, air_force(tyre.state));
  PhysicalFigures told;
  const double deflection = load / air_stiffness(tyre.state);
  told.figures.emplace_back(
      "load", fmt::format("{:.6g} N, {:.3g} of pressure times width times radius; the air bears it "
                          "on {:.3g} m2",
                          load, load / air_force(tyre.state), load / tyre.state.pressure));
  told.figures.emplace_back("deflection", fmt::format("about {}; an estimate by the air alone",
                                                      of_wall(deflection, tyre.wall)));
  std::string warning = unusual_load(key, load, tyre.state);
  if (warning.empty())
    warning = deeply_pressed(key, deflection, tyre.wall, "about ", "less load, or more pressure");
  add(std::move(warning), told);
  return told;
}

PhysicalFigures pressed_in(const std::string& key, double deflection, const PressedTyre& tyre) {
  RONDO_DEMAND(deflection > 0.0, deflection);
  PhysicalFigures told;
  told.figures.emplace_back("deflection", of_wall(deflection, tyre.wall));
  if (const double load = deflection * air_stiffness(tyre.state); load > 0.0)
    told.figures.emplace_back("load", fmt::format("about {:.6g} N, {:.2g} of pressure times width "
                                                  "times radius; an estimate by the air alone",
                                                  two_digits(load), load / air_force(tyre.state)));
  const char* const less =
      key == "analysis.depth" ? "a smaller analysis.depth" : "a larger motion.height";
  add(deeply_pressed(key, deflection, tyre.wall, "", less), told);
  return told;
}

std::string stays_clear(const std::string& key, double gap, double lean, const PressedTyre& tyre) {
  const double shoulder = 0.5 * tyre.state.width * std::sin(std::abs(lean));
  if (gap <= shoulder || gap > clear_share * tyre.wall.radius) return {};
  return fmt::format(
      "{}: the inflated wheel, whose radius is {:.4g} m, stays {:.3g} m above the ground, and "
      "nothing presses it; give a smaller height: it touches where its center is less than {:.4g} "
      "m above the ground",
      key, tyre.wall.radius, gap, tyre.wall.radius);
}

}  // namespace rondo::study
