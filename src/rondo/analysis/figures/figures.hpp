// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of a run that is done, from its files: what a sweep compares its members by.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/output/run_files.hpp"

namespace rondo::study {

struct FigureColumn {
  std::string_view name, unit, meaning;
};

/// Part of a run that means and peaks are taken over [s]; absent: its last half, up to its end.
struct Window {
  std::optional<double> from, to;
};

struct FigureTable {
  std::span<const FigureColumn> columns;
  /// A figure per column. @throws FileError: the files cannot be read, or hold no row in the window
  std::vector<double> (*of)(const std::filesystem::path& directory, const Window& window);
  bool has_window = true;  ///< false: the end alone counts, and a window means nothing
};

/// Results of a run without files.
struct DirectRun {
  std::string trouble;          ///< what ended it; empty: it is done
  long long steps = 0;          ///< done, as in run.json
  std::vector<double> figures;  ///< one for each column; empty: there is trouble
};

/// NaN where it has no such number.
[[nodiscard]] double figure_in(const Json& run, const char* key);

/// Adds the residuals of energy and contact, the penetration, strain_max and jacobian_min; NaN
/// where run.json has none.
void add_figures_of_all(const Json& run, std::vector<double>& figures);

}  // namespace rondo::study
