// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a sweep takes from each of its runs: the figures of a row of results.csv.
#pragma once
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/study/sweep/sweep_study.hpp"

namespace rondo::study {

struct FigureColumn {
  std::string_view name, unit, meaning;
};

/// In the order of the columns of results.csv.
[[nodiscard]] std::span<const FigureColumn> figure_columns(AnalysisKind kind) noexcept;

/// Of a run that is done, from its history.csv and run.json: as many as figure_columns().
/// @throws FileError: they cannot be read, or hold no row in the window
[[nodiscard]] std::vector<double> figures_of(const std::filesystem::path& directory,
                                             AnalysisKind kind, const Window& window);

}  // namespace rondo::study
