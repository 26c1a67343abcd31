// SPDX-License-Identifier: BSD-3-Clause
/// @file  The analysis of a wheel in three dimensions that rolls steadily (docs/wheel3d.md).
#pragma once
#include <memory>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

/// @pre is_solid(c). @throws InputError: the case cannot run so, or a run is to be resumed
[[nodiscard]] std::unique_ptr<Analysis> make_solid_steady_rolling(const Case& c,
                                                                  const RunOptions& options);

/// Its figures alone. @throws InputError likewise
[[nodiscard]] DirectRun solve_solid_steady_rolling(const Case& c, const RunOptions& options);

}  // namespace rondo::study
