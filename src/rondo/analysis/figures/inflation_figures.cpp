// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/figures/inflation_figures.hpp"

#include <array>

#include "rondo/analysis/figures/history_statistics.hpp"
#include "rondo/io/csv.hpp"

namespace rondo::study {
namespace {

constexpr std::array inflation_columns{
    FigureColumn{"load_share", "1", "of pressure, spin and mounting that was reached"},
    FigureColumn{"outer_radius_m", "m", "of the contact curve, else of all nodes"},
    FigureColumn{"width_m", "m", "along the axle"},
    FigureColumn{"twist_m", "m", "largest displacement around the axle"},
    FigureColumn{"cavity_volume_m3", "m³", "between the liner and the ring that joins its ends"},
    FigureColumn{"det_f_min", "1", "smallest at a point of the rubber"},
    FigureColumn{"stretch_max", "1", "largest principal stretch at a point of the rubber"},
    FigureColumn{"cord_force_min_n", "N", "smallest of all cords"},
    FigureColumn{"cord_force_max_n", "N", "largest of all cords"},
};

std::vector<double> figures_of_inflation(const std::filesystem::path& directory,
                                         const Window& /*none*/) {
  const std::filesystem::path file = directory / "history.csv";
  const Columns history = io::read_columns(file);
  std::vector<double> figures;
  for (const FigureColumn& figure : inflation_columns)
    figures.push_back(column(history, figure.name, file).back());
  return figures;
}

}  // namespace

FigureTable inflation_figures() noexcept {
  return {inflation_columns, figures_of_inflation, false};
}

}  // namespace rondo::study
