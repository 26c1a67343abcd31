// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/steady_figures.hpp"

#include <array>
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
    FigureColumn{"torque", "N·m", "on the rim, clockwise: > 0 drives"},
    FigureColumn{"height_m", "m", "of the center above y = 0, along the normal"},
    FigureColumn{"speed", "m/s", "of the center"},
    FigureColumn{"slip_ratio", "1", "as in history.csv"},
    FigureColumn{"rolling_resistance", "N", "power lost over speed"},
    FigureColumn{"cornering_stiffness", "N/rad", "-∂force_lateral/∂slip_angle there"},
    FigureColumn{"stick_share", "1", "of the area of contact, what sticks"},
    FigureColumn{"contact_area_m2", "m2", "mean over a sector's pass"},
    FigureColumn{"pressure_max_pa", "Pa", "largest"},
    FigureColumn{"shear_max_pa", "Pa", "largest"},
    FigureColumn{"friction_power", "W", "taken by friction"},
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

std::vector<double> solid_figures_in(const std::filesystem::path& directory,
                                     const Window& /*none*/) {
  return solid_steady_figures_of(io::read_json(directory / "run.json"));
}

std::vector<double> figures_in(const std::filesystem::path& directory, const Window& /*none*/) {
  return steady_figures_of(io::read_json(directory / "run.json"));
}

}  // namespace

std::vector<double> steady_figures_of(const Json& run) {
  const Json steady = run.value("steady", Json::object());
  const double stick = number(steady, "stick_length"), slip = number(steady, "slip_length");
  std::vector<double> figures;
  for (const char* key :
       {"force_x", "force_y", "torque", "height", "speed", "slip_ratio", "rolling_resistance"})
    figures.push_back(number(steady, key));
  figures.push_back(stick / (stick + slip));
  figures.push_back(stick + slip);
  figures.push_back(number(steady, "pressure_max"));
  figures.push_back(number(steady, "shear_max"));
  figures.push_back(number(steady.value("power", Json::object()), "friction"));
  figures.push_back(number(steady, "scheme_share"));
  add_figures_of_all(run, figures);
  return figures;
}

FigureTable steady_figures() noexcept {
  return {steady_columns, figures_in, false};
}

std::vector<double> solid_steady_figures_of(const Json& run) {
  const Json steady = run.value("steady", Json::object());
  const double stick = number(steady, "stick_area"), slip = number(steady, "slip_area");
  std::vector<double> figures;
  for (const char* key :
       {"force_x", "force_y", "force_lateral", "moment_aligning", "moment_overturning", "torque",
        "height", "speed", "slip_ratio", "rolling_resistance"})
    figures.push_back(number(steady, key));
  const Json by_angle =
      steady.value("slopes", Json::object()).value("by_slip_angle", Json::object());
  figures.push_back(-number(by_angle, "force_lateral"));
  figures.push_back(stick / (stick + slip));
  figures.push_back(stick + slip);
  figures.push_back(number(steady, "pressure_max"));
  figures.push_back(number(steady, "shear_max"));
  figures.push_back(number(steady.value("power", Json::object()), "friction"));
  figures.push_back(number(steady, "scheme_share"));
  add_figures_of_all(run, figures);
  return figures;
}

FigureTable solid_steady_figures() noexcept {
  return {steady_solid_columns, solid_figures_in, false};
}

}  // namespace rondo::study
