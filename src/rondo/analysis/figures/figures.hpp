// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of a run that is done, from its files: what a sweep compares its members by.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
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

/// Unit of a figure that a kind of body does not have.
inline constexpr std::string_view no_unit;

/// A figure with its units for a plane body and for a wheel in three dimensions.
struct FigureRow {
  std::string_view name, plane_unit, solid_unit, meaning;

  [[nodiscard]] constexpr std::string_view unit(bool solid) const noexcept {
    return solid ? solid_unit : plane_unit;
  }
};

/// The figures that one kind of body has, in the order of `rows`, an array of FigureRow.
template <const auto& rows, bool solid>
[[nodiscard]] constexpr auto columns_of() noexcept {
  constexpr auto has_unit = [](const FigureRow& row) { return !row.unit(solid).empty(); };
  std::array<FigureColumn, std::ranges::count_if(rows, has_unit)> columns;
  std::size_t k = 0;
  for (const FigureRow& row : rows)
    if (has_unit(row)) columns[k++] = {row.name, row.unit(solid), row.meaning};
  return columns;
}

/// Moments of a wheel in three dimensions at one time, or of steady rolling.
inline constexpr FigureRow aligning_moment{"moment_aligning", no_unit, "N·m",
                                           "of the ground on the wheel about the normal"},
    overturning_moment{"moment_overturning", no_unit, "N·m",
                       "about the heading, in the ground below the center"},
    aligning_moment_iso{"moment_aligning_iso", no_unit, "N·m",
                        "about the contact centre of ISO 8855"},
    overturning_moment_iso{"moment_overturning_iso", no_unit, "N·m",
                           "about the contact centre of ISO 8855"};

/// Figures of all analyses that touch the ground, as add_figures_of_all() adds them.
inline constexpr FigureRow energy_residual{
    "energy_residual_relative", "1", "1", "of the balance of energies or powers, of the whole run"},
    contact_residual{"contact_residual_max", "1", "1", "of the contact law, of the whole run"},
    largest_penetration{"penetration_max_m", "m", "m", "of the whole run"},
    largest_strain{"strain_max", "1", "1", "largest principal strain, of the whole run"},
    least_jacobian{"jacobian_min", "1", "1",
                   "least area (plane) or volume of an element over that undeformed"};

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
