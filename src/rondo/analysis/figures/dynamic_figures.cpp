// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/dynamic_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "rondo/analysis/figures/window_rows.hpp"
#include "rondo/io/files.hpp"

namespace rondo::study {
namespace {

constexpr std::array dynamic_rows{
    FigureRow{"force_x_mean", "N/m", "N",
              "of the ground on the body along its heading, mean over the window"},
    FigureRow{"force_x_peak", "N/m", "N", "of largest magnitude in the window"},
    FigureRow{"force_x_fluctuation", "N/m", "N", "root mean square about the mean"},
    FigureRow{"force_y_mean", "N/m", "N",
              "of the ground on the body along the normal, mean over the window"},
    FigureRow{"force_y_peak", "N/m", "N", "of largest magnitude in the window"},
    FigureRow{"force_y_fluctuation", "N/m", "N", "root mean square about the mean"},
    FigureRow{"force_lateral_mean", no_unit, "N",
              "of the ground on the body along t2, to the right of travel, mean over the window"},
    FigureRow{"force_lateral_peak", no_unit, "N", "of largest magnitude in the window"},
    FigureRow{"force_lateral_fluctuation", no_unit, "N", "root mean square about the mean"},
    FigureRow{"torque_mean", "N·m/m", "N·m", "about the center or axle, mean over the window"},
    FigureRow{"torque_peak", "N·m/m", "N·m", "of largest magnitude in the window"},
    FigureRow{"torque_fluctuation", "N·m/m", "N·m", "root mean square about the mean"},
    FigureRow{"moment_aligning_mean", no_unit, "N·m", "about the normal, mean over the window"},
    FigureRow{"moment_aligning_peak", no_unit, "N·m", "of largest magnitude in the window"},
    FigureRow{"moment_aligning_fluctuation", no_unit, "N·m", "root mean square about the mean"},
    FigureRow{"moment_overturning_mean", no_unit, "N·m",
              "about the heading in the ground, mean over the window"},
    FigureRow{"moment_aligning_iso_mean", no_unit, "N·m",
              "about the contact centre of ISO 8855, mean over the window"},
    FigureRow{"moment_overturning_iso_mean", no_unit, "N·m",
              "about the contact centre of ISO 8855, mean over the window"},
    FigureRow{"trail_m", no_unit, "m",
              "mean aligning moment over the mean lateral force; none where that is round-off"},
    FigureRow{"contact_length_mean_m", "m", no_unit, "mean over the window"},
    FigureRow{"contact_length_peak_m", "m", no_unit, "largest in the window"},
    FigureRow{"contact_area_mean_m2", no_unit, "m2", "mean over the window"},
    FigureRow{"contact_area_peak_m2", no_unit, "m2", "largest in the window"},
    FigureRow{"footprint_length_mean_m", no_unit, "m",
              "extent of the contact along the heading, mean over the window"},
    FigureRow{"footprint_width_mean_m", no_unit, "m",
              "extent of the contact across the heading, mean over the window"},
    FigureRow{"pressure_mean_pa", no_unit, "Pa", "force_y_mean over contact_area_mean_m2"},
    FigureRow{"slip_angle_mean", no_unit, "rad", "mean over the window"},
    FigureRow{"slip_ratio_mean", "1", "1", "mean over the window"},
    FigureRow{"center_y_mean", "m", "m",
              "height of the center along the normal, mean over the window"},
    FigureRow{"speed_mean", "m/s", "m/s", "of the center along its heading, mean over the window"},
    FigureRow{"spin_mean", "rad/s", "rad/s", "> 0 clockwise, mean over the window"},
    FigureRow{"friction_power", "W/m", "W",
              "dissipated by friction in the window, over its length"},
    FigureRow{"impact_power", "W/m", "W", "lost in impacts in the window, over its length"},
    energy_residual,
    contact_residual,
    largest_penetration,
    largest_strain,
    least_jacobian,
};
constexpr auto dynamic_columns = columns_of<dynamic_rows, false>();
constexpr auto dynamic_solid_columns = columns_of<dynamic_rows, true>();

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
