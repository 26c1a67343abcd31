// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/steady_figures.hpp"

#include <array>
#include <initializer_list>
#include <limits>

#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

constexpr const char* scheme_share =
    "power of the discretisation over the largest of drive, damping and friction";

constexpr std::array steady_columns{
    FigureColumn{"force_x", "N/m", "of the ground on the body, mean over a sector's pass"},
    FigureColumn{"force_y", "N/m", "likewise"},
    FigureColumn{"torque", "N", "on the rim, clockwise: > 0 drives"},
    FigureColumn{"height_m", "m", "of the center above y = 0"},
    FigureColumn{"speed", "m/s", "of the center"},
    FigureColumn{"slip_ratio", "1", "as in history.csv"},
    FigureColumn{"rolling_resistance", "N/m", "power lost over speed"},
    FigureColumn{"stick_share", "1", "of the length of contact, what sticks"},
    FigureColumn{"contact_length_m", "m", "mean over a sector's pass"},
    FigureColumn{"pressure_max_pa", "Pa", "largest"},
    FigureColumn{"shear_max_pa", "Pa", "largest"},
    FigureColumn{"friction_power", "W/m", "taken by friction"},
    FigureColumn{"material_power", "W/m", "taken by viscous materials"},
    FigureColumn{"damping_power", "W/m", "taken by mass and stiffness damping"},
    FigureColumn{"scheme_share", "1", scheme_share},
    FigureColumn{"energy_residual_relative", "1", "of the balance of powers"},
    FigureColumn{"contact_residual_max", "1", "of the contact law"},
    FigureColumn{"penetration_max_m", "m", "largest"},
    FigureColumn{"strain_max", "1", "largest principal strain"},
    FigureColumn{"jacobian_min", "1", "least area of an element over that undeformed"},
};

constexpr std::array steady_solid_columns{
    FigureColumn{"force_x", "N",
                 "of the ground on the wheel along its heading, mean over a "
                 "sector's pass"},
    FigureColumn{"force_y", "N", "likewise, along the normal of the ground"},
    FigureColumn{"force_lateral", "N", "likewise, to the right of the heading"},
    FigureColumn{"moment_aligning", "N·m", "of the ground on the wheel about the normal"},
    FigureColumn{"moment_overturning", "N·m", "about the heading, in the ground below the center"},
    FigureColumn{"moment_aligning_iso", "N·m", "about the contact centre of ISO 8855"},
    FigureColumn{"moment_overturning_iso", "N·m", "likewise"},
    FigureColumn{"torque", "N·m", "on the rim, clockwise: > 0 drives"},
    FigureColumn{"height_m", "m", "of the center above y = 0, along the normal"},
    FigureColumn{"speed", "m/s", "of the center"},
    FigureColumn{"slip_ratio", "1", "as in history.csv"},
    FigureColumn{"rolling_resistance", "N", "power lost over speed"},
    FigureColumn{"cornering_stiffness", "N/rad", "-∂force_lateral/∂slip_angle there"},
    FigureColumn{"relaxation_length_m", "m",
                 "after a step of the slip: of force_lateral, or of force_x"},
    FigureColumn{"stick_share", "1", "of the area of contact, what sticks"},
    FigureColumn{"contact_area_m2", "m2", "mean over a sector's pass"},
    FigureColumn{"footprint_length_m", "m", "extent of the contact along the heading, likewise"},
    FigureColumn{"footprint_width_m", "m", "likewise across"},
    FigureColumn{"pressure_mean_pa", "Pa", "force_y over contact_area_m2"},
    FigureColumn{"pressure_max_pa", "Pa", "largest"},
    FigureColumn{"shear_max_pa", "Pa", "largest"},
    FigureColumn{"friction_power", "W", "taken by friction"},
    FigureColumn{"material_power", "W", "taken by viscous materials"},
    FigureColumn{"damping_power", "W", "taken by mass and stiffness damping"},
    FigureColumn{"scheme_share", "1", scheme_share},
    FigureColumn{"energy_residual_relative", "1", "of the balance of powers"},
    FigureColumn{"contact_residual_max", "1", "of the contact law"},
    FigureColumn{"penetration_max_m", "m", "largest"},
    FigureColumn{"strain_max", "1", "largest principal strain"},
    FigureColumn{"jacobian_min", "1", "least volume of an element over that undeformed"},
};

double number(const Json& j, const char* key) {
  return j.contains(key) && j[key].is_number() ? j[key].get<double>()
                                               : std::numeric_limits<double>::quiet_NaN();
}

template <bool solid>
std::vector<double> figures_in(const std::filesystem::path& directory, const Window& /*none*/) {
  return steady_figures_of(io::read_json(directory / "run.json"), solid);
}

}  // namespace

std::vector<double> steady_figures_of(const Json& run, bool solid) {
  const Json steady = run.value("steady", Json::object());
  const double stick = number(steady, solid ? "stick_area" : "stick_length"),
               slip = number(steady, solid ? "slip_area" : "slip_length");
  std::vector<double> figures;
  const auto add = [&](std::initializer_list<const char*> keys) {
    for (const char* key : keys) figures.push_back(number(steady, key));
  };
  add({"force_x", "force_y"});
  if (solid)
    add({"force_lateral", "moment_aligning", "moment_overturning", "moment_aligning_iso",
         "moment_overturning_iso"});
  add({"torque", "height", "speed", "slip_ratio", "rolling_resistance"});
  if (solid) {
    const Json slopes = steady.value("slopes", Json::object());
    figures.push_back(-number(slopes.value("by_slip_angle", Json::object()), "force_lateral"));
    const Json step = run.value("slip_step", Json::object());
    const char* force = step.contains("force_lateral") ? "force_lateral" : "force_x";
    figures.push_back(number(step.value(force, Json::object()), "relaxation_length"));
  }
  figures.push_back(stick / (stick + slip));
  figures.push_back(stick + slip);
  if (solid) add({"footprint_length", "footprint_width", "pressure_mean"});
  add({"pressure_max", "shear_max"});
  const Json power = steady.value("power", Json::object());
  for (const char* taker : {"friction", "viscosity"}) figures.push_back(number(power, taker));
  figures.push_back(number(power, "mass") + number(power, "stiffness"));
  add({"scheme_share"});
  add_figures_of_all(run, figures);
  return figures;
}

FigureTable steady_figures() noexcept {
  return {steady_columns, figures_in<false>, false};
}

FigureTable solid_steady_figures() noexcept {
  return {steady_solid_columns, figures_in<true>, false};
}

}  // namespace rondo::study
