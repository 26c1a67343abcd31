// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of an inflation.
#pragma once
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

[[nodiscard]] FigureTable inflation_figures() noexcept;

}  // namespace rondo::study
