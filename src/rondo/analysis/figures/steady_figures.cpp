// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/steady_figures.hpp"

#include <array>
#include <initializer_list>

#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

constexpr std::array steady_rows{
    FigureRow{"force_x", "N/m", "N", "on the body along its heading, mean over a sector's pass"},
    FigureRow{"force_y", "N/m", "N", "on the body along the normal, mean over a sector's pass"},
    FigureRow{"force_lateral", no_unit, "N",
              "on the body to the right of its heading, mean over a sector's pass"},
    aligning_moment,
    overturning_moment,
    aligning_moment_iso,
    overturning_moment_iso,
    FigureRow{"torque", "N", "N·m", "on the rim, clockwise: > 0 drives"},
    FigureRow{"height_m", "m", "m", "of the center above y = 0, along the normal"},
    FigureRow{"speed", "m/s", "m/s", "of the center"},
    FigureRow{"slip_ratio", "1", "1", "as in history.csv"},
    FigureRow{"rolling_resistance", "N/m", "N", "power lost over speed"},
    FigureRow{"cornering_stiffness", no_unit, "N/rad", "-∂force_lateral/∂slip_angle there"},
    FigureRow{"relaxation_length_m", no_unit, "m",
              "after a step of the slip: of force_lateral, or of force_x"},
    FigureRow{"stick_share", "1", "1", "of the length or area of contact, what sticks"},
    FigureRow{"contact_length_m", "m", no_unit, "mean over a sector's pass"},
    FigureRow{"contact_area_m2", no_unit, "m2", "mean over a sector's pass"},
    FigureRow{"footprint_length_m", no_unit, "m",
              "extent of the contact along the heading, mean over a sector's pass"},
    FigureRow{"footprint_width_m", no_unit, "m",
              "extent of the contact across the heading, mean over a sector's pass"},
    FigureRow{"pressure_mean_pa", no_unit, "Pa", "force_y over contact_area_m2"},
    FigureRow{"pressure_max_pa", "Pa", "Pa", "largest"},
    FigureRow{"shear_max_pa", "Pa", "Pa", "largest"},
    FigureRow{"friction_power", "W/m", "W", "taken by friction"},
    FigureRow{"material_power", "W/m", "W", "taken by viscous materials"},
    FigureRow{"damping_power", "W/m", "W", "taken by mass and stiffness damping"},
    FigureRow{"scheme_share", "1", "1",
              "power of the discretisation over the largest of drive, damping and friction"},
    energy_residual,
    contact_residual,
    largest_penetration,
    largest_strain,
    least_jacobian,
};
constexpr auto steady_columns = columns_of<steady_rows, false>();
constexpr auto steady_solid_columns = columns_of<steady_rows, true>();

template <bool solid>
std::vector<double> figures_in(const std::filesystem::path& directory, const Window& /*none*/) {
  return steady_figures_of(io::read_json(directory / "run.json"), solid);
}

}  // namespace

std::vector<double> steady_figures_of(const Json& run, bool solid) {
  const Json steady = run.value("steady", Json::object());
  const double stick = figure_in(steady, solid ? "stick_area" : "stick_length"),
               slip = figure_in(steady, solid ? "slip_area" : "slip_length");
  std::vector<double> figures;
  const auto add = [&](std::initializer_list<const char*> keys) {
    for (const char* key : keys) figures.push_back(figure_in(steady, key));
  };
  add({"force_x", "force_y"});
  if (solid)
    add({"force_lateral", "moment_aligning", "moment_overturning", "moment_aligning_iso",
         "moment_overturning_iso"});
  add({"torque", "height", "speed", "slip_ratio", "rolling_resistance"});
  if (solid) {
    const Json slopes = steady.value("slopes", Json::object());
    figures.push_back(-figure_in(slopes.value("by_slip_angle", Json::object()), "force_lateral"));
    const Json step = run.value("slip_step", Json::object());
    const char* force = step.contains("force_lateral") ? "force_lateral" : "force_x";
    figures.push_back(figure_in(step.value(force, Json::object()), "relaxation_length"));
  }
  figures.push_back(stick / (stick + slip));
  figures.push_back(stick + slip);
  if (solid) add({"footprint_length", "footprint_width", "pressure_mean"});
  add({"pressure_max", "shear_max"});
  const Json power = steady.value("power", Json::object());
  for (const char* taker : {"friction", "viscosity"}) figures.push_back(figure_in(power, taker));
  figures.push_back(figure_in(power, "mass") + figure_in(power, "stiffness"));
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
