// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures of a crush.
#pragma once
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

[[nodiscard]] FigureTable crush_figures() noexcept;

}  // namespace rondo::study
