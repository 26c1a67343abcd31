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
};

std::vector<double> figures_of(const std::filesystem::path& directory, const Window& /*none*/) {
  const std::filesystem::path file = directory / "history.csv";
  const Columns history = io::read_columns(file);
  std::vector<double> figures;
  for (const char* name : {"depth_m", "force_x", "force_y", "torque", "contact_length_m",
                           "pressure_max_pa", "shear_max_pa", "strain", "dissipation_friction"})
    figures.push_back(column(history, name, file).back());
  add_figures_of_all(io::read_json(directory / "run.json"), figures);
  return figures;
}

}  // namespace

FigureTable crush_figures() noexcept {
  return {crush_columns, figures_of, false};
}

}  // namespace rondo::study
