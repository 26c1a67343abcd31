// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of columns of history.csv that a study names: probes, forces of the hub,
/// energies.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rondo/analysis/figures/figures.hpp"
#include "rondo/core/column.hpp"

namespace rondo::study {

enum class Statistic { mean, min, max, last };

struct ChosenFigure {
  std::string column;  ///< column of history.csv
  Statistic statistic = Statistic::last;
  ColumnLabel label;  ///< label in the table of the sweep
};

/// NAME_mean, NAME_min, NAME_max and NAME_last of each, without a mean where there is no window; of
/// them those that the table has not by itself.
/// @param history  the columns that there are @throws InputError, said of `file`: no such column
[[nodiscard]] std::vector<ChosenFigure> choose_figures(std::span<const std::string> names,
                                                       std::span<const ColumnLabel> history,
                                                       const FigureTable& table,
                                                       const std::filesystem::path& file);

/// The figures of a finished run: over the rows of the window, or over all rows if it has none.
/// @throws FileError as FigureTable::of
[[nodiscard]] std::vector<double> values_of(std::span<const ChosenFigure> figures,
                                            const std::filesystem::path& directory,
                                            const Window& window, bool has_window);

}  // namespace rondo::study
