// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of a crush.
#pragma once
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

[[nodiscard]] FigureTable crush_figures() noexcept;
/// The figures of the crush of a wheel in three dimensions.
[[nodiscard]] FigureTable wheel_crush_figures() noexcept;
/// The figures of a crush, and what LATIN did.
[[nodiscard]] FigureTable latin_figures() noexcept;
/// The figures of LATIN, and what LATIN-PGD did; NaN where run.json does not have it.
[[nodiscard]] FigureTable pgd_figures() noexcept;

}  // namespace rondo::study
