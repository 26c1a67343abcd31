// SPDX-License-Identifier: BSD-3-Clause
/// @file  A linear body, all increments at once: LATIN and LATIN-PGD (docs/latin.md).
#pragma once
#include "rondo/analysis/crush/crush_solver.hpp"

namespace rondo::study {

[[nodiscard]] std::unique_ptr<CrushSolver> make_latin_solver(const Case& c,
                                                             const RunOptions& options,
                                                             const CrushSetup& setup);

/// Texts of the members that this solver adds to run.json.
std::vector<MemberText> latin_members();

}  // namespace rondo::study
