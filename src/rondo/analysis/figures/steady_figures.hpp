// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of steady rolling.
#pragma once
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

[[nodiscard]] FigureTable steady_figures() noexcept;

/// Figures from what run.json says.
[[nodiscard]] std::vector<double> steady_figures_of(const Json& run);

/// Figures of a wheel in three dimensions.
[[nodiscard]] FigureTable solid_steady_figures() noexcept;
[[nodiscard]] std::vector<double> solid_steady_figures_of(const Json& run);

}  // namespace rondo::study
