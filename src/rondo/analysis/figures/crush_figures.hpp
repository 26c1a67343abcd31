// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of a crush.
#pragma once
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

[[nodiscard]] FigureTable crush_figures() noexcept;
/// The same, and what LATIN did.
[[nodiscard]] FigureTable latin_figures() noexcept;
/// The same, and what LATIN-PGD did; NaN of runs that know nothing of it.
[[nodiscard]] FigureTable pgd_figures() noexcept;

}  // namespace rondo::study
