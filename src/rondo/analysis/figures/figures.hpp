// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of a run that is done, from its files: what a sweep compares its members by.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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
  /// As many as columns. @throws FileError: the files cannot be read, or hold no row in the window
  std::vector<double> (*of)(const std::filesystem::path& directory, const Window& window);
  bool has_window = true;  ///< false: the end alone counts, and a window means nothing
};

/// Adds the residuals of energy and contact, the penetration, strain_max and jacobian_min, from
/// run.json; NaN where it has none. @throws FileError
void add_figures_of_all(const std::filesystem::path& directory, std::vector<double>& figures);

}  // namespace rondo::study
