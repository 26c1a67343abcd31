// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of steady rolling.
#pragma once
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

[[nodiscard]] FigureTable steady_figures() noexcept;
/// The table for wheels in three dimensions.
[[nodiscard]] FigureTable solid_steady_figures() noexcept;

/// The figures from the contents of run.json. @param solid a wheel in three dimensions
[[nodiscard]] std::vector<double> steady_figures_of(const Json& run, bool solid);

}  // namespace rondo::study
