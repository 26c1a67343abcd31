// SPDX-License-Identifier: BSD-3-Clause
/// @file  A linear body condensed on its candidates, increment by increment (docs/theory.md, 6.4).
#pragma once
#include "rondo/analysis/crush/crush_solver.hpp"

namespace rondo::study {

[[nodiscard]] std::unique_ptr<CrushSolver> make_direct_solver(const Case& c,
                                                              const RunOptions& options,
                                                              const CrushSetup& setup);

/// Factorised, and nothing condensed: that of the run before where it fits.
[[nodiscard]] std::shared_ptr<statics::Condensation> factorised(const Case& c,
                                                                const CrushSetup& setup,
                                                                SharedBody* shared);

}  // namespace rondo::study
