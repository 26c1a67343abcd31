// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/crush_figures.hpp"
#include "rondo/io/files.hpp"

#include <array>

#include "rondo/analysis/figures/history_statistics.hpp"
#include "rondo/io/csv.hpp"

namespace rondo::study {
namespace {

constexpr std::array crush_columns{
    FigureColumn{"depth_m", "m", "of the center below first touch, at the end"},
    FigureColumn{"force_x", "N/m", "of the ground on the body, at the end"},
    FigureColumn{"force_y", "N/m", "of the ground on the body, at the end"},
    FigureColumn{"torque", "N·m/m", "about the center, at the end"},
    FigureColumn{"contact_length_m", "m", "at the end"},
    FigureColumn{"pressure_max_pa", "Pa", "at the end"},
    FigureColumn{"shear_max_pa", "Pa", "at the end"},
    FigureColumn{"strain", "J/m", "strain energy at the end"},
    FigureColumn{"dissipation_friction", "J/m", "dissipated by friction"},
    FigureColumn{"energy_residual_relative", "1", "of the balance of energies"},
    FigureColumn{"contact_residual_max", "1", "of the contact law"},
    FigureColumn{"penetration_max_m", "m", "of all increments"},
    FigureColumn{"strain_max", "1", "largest principal strain, of all increments"},
    FigureColumn{"jacobian_min", "1", "least area of an element over that undeformed"},
    FigureColumn{"iterations", "1", "of LATIN, each on all increments"},
    FigureColumn{"residual", "1", "of the laws of contact at all increments, which ended them"},
    FigureColumn{"modes", "1", "of LATIN-PGD, after its last cut"},
    FigureColumn{"solves", "1", "of LATIN-PGD, one a field that it found"},
};
constexpr std::size_t n_of_all = 14, n_of_latin = 16;

constexpr std::array wheel_columns{
    FigureColumn{"depth_m", "m", "of the center below first touch, at the end"},
    FigureColumn{"force_x", "N", "of the ground on the wheel along its heading, at the end"},
    FigureColumn{"force_y", "N", "likewise, along the normal of the ground"},
    FigureColumn{"force_lateral", "N", "likewise, to the right of the heading"},
    FigureColumn{"moment_aligning", "N·m", "of the ground on the wheel about the normal"},
    FigureColumn{"moment_overturning", "N·m", "about the heading, in the ground below the center"},
    FigureColumn{"moment_aligning_iso", "N·m", "about the contact centre of ISO 8855"},
    FigureColumn{"moment_overturning_iso", "N·m", "likewise"},
    FigureColumn{"torque", "N·m", "about the center, at the end"},
    FigureColumn{"contact_area_m2", "m2", "at the end"},
    FigureColumn{"footprint_length_m", "m", "extent of the contact along the heading, at the end"},
    FigureColumn{"footprint_width_m", "m", "likewise across"},
    FigureColumn{"pressure_mean_pa", "Pa", "force_y over contact_area_m2"},
    FigureColumn{"pressure_max_pa", "Pa", "at the end"},
    FigureColumn{"shear_max_pa", "Pa", "at the end"},
    FigureColumn{"strain", "J", "strain energy at the end"},
    FigureColumn{"dissipation_friction", "J", "dissipated by friction"},
    FigureColumn{"height_m", "m", "of the center above y = 0, at the end"},
    FigureColumn{"energy_residual_relative", "1", "of the balance of energies"},
    FigureColumn{"contact_residual_max", "1", "of the contact law"},
    FigureColumn{"penetration_max_m", "m", "of all increments"},
    FigureColumn{"strain_max", "1", "largest principal strain, of all increments"},
    FigureColumn{"jacobian_min", "1", "least volume of an element over that undeformed"},
};

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
