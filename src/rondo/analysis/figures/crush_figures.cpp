// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/crush_figures.hpp"
#include "rondo/io/files.hpp"

#include <array>

#include "rondo/analysis/figures/history_statistics.hpp"
#include "rondo/io/csv.hpp"

namespace rondo::study {
namespace {

constexpr std::array crush_rows{
    FigureRow{"depth_m", "m", "m", "of the center below first touch, at the end"},
    FigureRow{"force_x", "N/m", "N", "of the ground on the body along its heading, at the end"},
    FigureRow{"force_y", "N/m", "N", "of the ground on the body along the normal, at the end"},
    FigureRow{"force_lateral", no_unit, "N",
              "of the ground on the body to the right of its heading, at the end"},
    aligning_moment,
    overturning_moment,
    aligning_moment_iso,
    overturning_moment_iso,
    FigureRow{"torque", "N·m/m", "N·m", "about the center, at the end"},
    FigureRow{"contact_length_m", "m", no_unit, "at the end"},
    FigureRow{"contact_area_m2", no_unit, "m2", "at the end"},
    FigureRow{"footprint_length_m", no_unit, "m",
              "extent of the contact along the heading, at the end"},
    FigureRow{"footprint_width_m", no_unit, "m",
              "extent of the contact across the heading, at the end"},
    FigureRow{"pressure_mean_pa", no_unit, "Pa", "force_y over contact_area_m2"},
    FigureRow{"pressure_max_pa", "Pa", "Pa", "at the end"},
    FigureRow{"shear_max_pa", "Pa", "Pa", "at the end"},
    FigureRow{"strain", "J/m", "J", "strain energy at the end"},
    FigureRow{"dissipation_friction", "J/m", "J", "dissipated by friction"},
    FigureRow{"height_m", no_unit, "m", "of the center above y = 0, at the end"},
    energy_residual,
    contact_residual,
    largest_penetration,
    largest_strain,
    least_jacobian,
    FigureRow{"iterations", "1", no_unit, "of LATIN, each on all increments"},
    FigureRow{"residual", "1", no_unit,
              "of the laws of contact at all increments, which ended them"},
    FigureRow{"modes", "1", no_unit, "of LATIN-PGD, after its last cut"},
    FigureRow{"solves", "1", no_unit, "of LATIN-PGD, one a field that it found"},
};
constexpr auto crush_columns = columns_of<crush_rows, false>();
constexpr auto wheel_columns = columns_of<crush_rows, true>();
constexpr std::size_t n_of_all = 14, n_of_latin = 16;

std::vector<double> wheel_figures_of(const std::filesystem::path& directory,
                                     const Window& /*none*/) {
  const std::filesystem::path file = directory / "history.csv";
  const Columns history = io::read_columns(file);
  std::vector<double> figures;
  for (const char* name :
       {"depth_m", "force_x", "force_y", "force_lateral", "moment_aligning", "moment_overturning",
        "moment_aligning_iso", "moment_overturning_iso", "torque", "contact_area_m2",
        "footprint_length_m", "footprint_width_m", "pressure_mean_pa", "pressure_max_pa",
        "shear_max_pa", "strain", "dissipation_friction", "center_y_m"})
    figures.push_back(column(history, name, file).back());
  add_figures_of_all(io::read_json(directory / "run.json"), figures);
  return figures;
}

/// The first n of the columns.
template <std::size_t n>
std::vector<double> figures_of(const std::filesystem::path& directory, const Window& /*none*/) {
  const std::filesystem::path file = directory / "history.csv";
  const Columns history = io::read_columns(file);
  std::vector<double> figures;
  for (const char* name : {"depth_m", "force_x", "force_y", "torque", "contact_length_m",
                           "pressure_max_pa", "shear_max_pa", "strain", "dissipation_friction"})
    figures.push_back(column(history, name, file).back());
  const Json run = io::read_json(directory / "run.json");
  add_figures_of_all(run, figures);
  for (const char* key : {"iterations", "residual", "modes", "solves"})
    figures.push_back(figure_in(run, key));
  figures.resize(n);
  return figures;
}

}  // namespace

FigureTable crush_figures() noexcept {
  return {std::span(crush_columns).first(n_of_all), figures_of<n_of_all>, false};
}

FigureTable wheel_crush_figures() noexcept {
  return {wheel_columns, wheel_figures_of, false};
}

FigureTable latin_figures() noexcept {
  return {std::span(crush_columns).first(n_of_latin), figures_of<n_of_latin>, false};
}

FigureTable pgd_figures() noexcept {
  return {crush_columns, figures_of<crush_columns.size()>, false};
}

}  // namespace rondo::study
