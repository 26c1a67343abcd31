// SPDX-License-Identifier: BSD-3-Clause
/// @file  The analysis of a body that rolls steadily, solved directly (docs/theory.md, 11).
#pragma once
#include <memory>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

/// @throws InputError: the case cannot run so, or a run is to be resumed
[[nodiscard]] std::unique_ptr<Analysis> make_steady_rolling(const Case& c,
                                                            const RunOptions& options);

/// Its figures alone. @throws InputError likewise
[[nodiscard]] DirectRun solve_steady_rolling(const Case& c, const RunOptions& options);

/// What steady rolling has in run.json, besides shared_members().
std::vector<MemberText> steady_members();

}  // namespace rondo::study
