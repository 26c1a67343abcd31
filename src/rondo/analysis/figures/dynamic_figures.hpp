// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of motion in time.
#pragma once
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

[[nodiscard]] FigureTable dynamic_figures() noexcept;
/// Figures of a wheel in three dimensions: forces in N, with the lateral one and its moments.
[[nodiscard]] FigureTable solid_dynamic_figures() noexcept;

}  // namespace rondo::study
