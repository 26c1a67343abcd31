// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/dynamic_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "rondo/analysis/figures/window_rows.hpp"
#include "rondo/io/files.hpp"

namespace rondo::study {
namespace {

constexpr std::array dynamic_columns{
    FigureColumn{"force_x_mean", "N/m", "of the ground on the body, mean over the window"},
    FigureColumn{"force_x_peak", "N/m", "the value of largest magnitude in the window"},
    FigureColumn{"force_x_fluctuation", "N/m", "root mean square about the mean"},
    FigureColumn{"force_y_mean", "N/m", "of the ground on the body, mean over the window"},
    FigureColumn{"force_y_peak", "N/m", "the value of largest magnitude in the window"},
    FigureColumn{"force_y_fluctuation", "N/m", "root mean square about the mean"},
    FigureColumn{"torque_mean", "N·m/m", "about the center, mean over the window"},
    FigureColumn{"torque_peak", "N·m/m", "the value of largest magnitude in the window"},
    FigureColumn{"torque_fluctuation", "N·m/m", "root mean square about the mean"},
    FigureColumn{"contact_length_mean_m", "m", "mean over the window"},
    FigureColumn{"contact_length_peak_m", "m", "largest in the window"},
    FigureColumn{"slip_ratio_mean", "1", "mean over the window"},
    FigureColumn{"center_y_mean", "m", "height of the center, mean over the window"},
    FigureColumn{"speed_mean", "m/s", "of the center along x, mean over the window"},
    FigureColumn{"spin_mean", "rad/s", "> 0 clockwise, mean over the window"},
    FigureColumn{"friction_power", "W/m", "dissipated by friction in the window, over its length"},
    FigureColumn{"impact_power", "W/m", "lost in impacts in the window, over its length"},
    FigureColumn{"energy_residual_relative", "1", "of the energy balance, of the whole run"},
    FigureColumn{"contact_residual_max", "1", "of the contact law, of the whole run"},
    FigureColumn{"penetration_max_m", "m", "of the whole run"},
    FigureColumn{"strain_max", "1", "largest principal strain, of the whole run"},
    FigureColumn{"jacobian_min", "1", "least area of an element over that undeformed"},
};

/// Columns of a wheel in three dimensions.
constexpr std::array dynamic_solid_columns{
    FigureColumn{"force_x_mean", "N", "of the ground on the body along t1, mean over the window"},
    FigureColumn{"force_x_peak", "N", "the value of largest magnitude in the window"},
    FigureColumn{"force_x_fluctuation", "N", "root mean square about the mean"},
    FigureColumn{"force_y_mean", "N", "along the normal n, mean over the window"},
    FigureColumn{"force_y_peak", "N", "the value of largest magnitude in the window"},
    FigureColumn{"force_y_fluctuation", "N", "root mean square about the mean"},
    FigureColumn{"force_lateral_mean", "N", "along t2, to the right of travel, mean"},
    FigureColumn{"force_lateral_peak", "N", "the value of largest magnitude in the window"},
    FigureColumn{"force_lateral_fluctuation", "N", "root mean square about the mean"},
    FigureColumn{"torque_mean", "N·m", "about the axle, mean over the window"},
    FigureColumn{"torque_peak", "N·m", "the value of largest magnitude in the window"},
    FigureColumn{"torque_fluctuation", "N·m", "root mean square about the mean"},
    FigureColumn{"moment_aligning_mean", "N·m", "about n, mean over the window"},
    FigureColumn{"moment_aligning_peak", "N·m", "the value of largest magnitude in the window"},
    FigureColumn{"moment_aligning_fluctuation", "N·m", "root mean square about the mean"},
    FigureColumn{"moment_overturning_mean", "N·m", "about t1 in the ground, mean"},
    FigureColumn{"moment_aligning_iso_mean", "N·m", "about the contact centre of ISO 8855, mean"},
    FigureColumn{"moment_overturning_iso_mean", "N·m", "likewise"},
    FigureColumn{"trail_m", "m",
                 "mean aligning moment over the mean lateral force; none where that is round-off"},
    FigureColumn{"contact_area_mean_m2", "m2", "mean over the window"},
    FigureColumn{"contact_area_peak_m2", "m2", "largest in the window"},
    FigureColumn{"footprint_length_mean_m", "m",
                 "extent of the contact along t1, mean over the window"},
    FigureColumn{"footprint_width_mean_m", "m", "likewise along t2"},
    FigureColumn{"pressure_mean_pa", "Pa", "force_y_mean over contact_area_mean_m2"},
    FigureColumn{"slip_angle_mean", "rad", "mean over the window"},
    FigureColumn{"slip_ratio_mean", "1", "mean over the window"},
    FigureColumn{"center_y_mean", "m", "height of the center along n, mean over the window"},
    FigureColumn{"speed_mean", "m/s", "of the center along t1, mean over the window"},
    FigureColumn{"spin_mean", "rad/s", "> 0 clockwise, mean over the window"},
    FigureColumn{"friction_power", "W", "dissipated by friction in the window, over its length"},
    FigureColumn{"impact_power", "W", "lost in impacts in the window, over its length"},
    FigureColumn{"energy_residual_relative", "1", "of the energy balance, of the whole run"},
    FigureColumn{"contact_residual_max", "1", "of the contact law, of the whole run"},
    FigureColumn{"penetration_max_m", "m", "of the whole run"},
    FigureColumn{"strain_max", "1", "largest principal strain, of the whole run"},
    FigureColumn{"jacobian_min", "1", "least volume of an element over that undeformed"},
};

/// Rest of a lateral force straight on, over the force that presses the wheel on the ground.
constexpr double round_off = 1e-9;

double peak(const Intervals& f) {
  return *std::ranges::max_element(f.value, {}, [](double value) { return std::abs(value); });
}

/// Mean, peak and fluctuation of each.
void add_courses(const WindowRows& rows, std::span<const char* const> names,
                 std::vector<double>& figures) {
  for (const char* name : names) {
    const Intervals f = rows.of(name);
    figures.insert(figures.end(), {mean(f), peak(f), deviation(f)});
  }
}

/// Slips, place, speeds, powers, and what run.json says.
void add_motion(const WindowRows& rows, const std::filesystem::path& directory,
                std::vector<double>& figures) {
  figures.insert(figures.end(), {mean(rows.of("slip_ratio")), mean(rows.of("center_y_m")),
                                 rows.rate("center_x_m"), rows.rate("angle_rad"),
                                 rows.rate("dissipation_friction"), rows.rate("loss_impact")});
  add_figures_of_all(io::read_json(directory / "run.json"), figures);
}

std::vector<double> figures_of(const std::filesystem::path& directory, const Window& window) {
  const WindowRows rows(directory, window);
  std::vector<double> figures;
  add_courses(rows, std::array{"force_x", "force_y", "torque"}, figures);
  const Intervals length = rows.of("contact_length_m");
  figures.insert(figures.end(), {mean(length), peak(length)});
  add_motion(rows, directory, figures);
  return figures;
}

std::vector<double> solid_figures_of(const std::filesystem::path& directory, const Window& window) {
  const WindowRows rows(directory, window);
  std::vector<double> figures;
  add_courses(rows, std::array{"force_x", "force_y", "force_lateral", "torque", "moment_aligning"},
              figures);
  const double lateral = mean(rows.of("force_lateral")),
               aligning = mean(rows.of("moment_aligning")), load = mean(rows.of("force_y"));
  const bool pulls = std::abs(lateral) > round_off * std::abs(load);
  const Intervals area = rows.of("contact_area_m2");
  const double mean_area = mean(area);
  figures.insert(
      figures.end(),
      {mean(rows.of("moment_overturning")), mean(rows.of("moment_aligning_iso")),
       mean(rows.of("moment_overturning_iso")),
       pulls ? aligning / lateral : std::numeric_limits<double>::quiet_NaN(), mean_area, peak(area),
       mean(rows.of("footprint_length_m")), mean(rows.of("footprint_width_m")),
       mean_area == 0.0 ? 0.0 : load / mean_area, mean(rows.of("slip_angle"))});
  add_motion(rows, directory, figures);
  return figures;
}

}  // namespace

FigureTable dynamic_figures() noexcept {
  return {dynamic_columns, figures_of, true};
}

FigureTable solid_dynamic_figures() noexcept {
  return {dynamic_solid_columns, solid_figures_of, true};
}

}  // namespace rondo::study
