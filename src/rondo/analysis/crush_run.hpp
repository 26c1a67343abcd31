// SPDX-License-Identifier: BSD-3-Clause
/// @file  The run of a crush, behind run_case.
#pragma once
#include <string>

#include "rondo/analysis/crush_build.hpp"
#include "rondo/analysis/run.hpp"
#include "rondo/statics/crush.hpp"

namespace rondo::study {

/// As run_case. @pre c is a crush
[[nodiscard]] RunReport run_crush(const Case& c, const RunOptions& options);

/// The stiffness condensed on the candidates within reach. @throws InputError: not definite
void condense(const Case& c, const CrushSetup& setup, statics::Condensation& body);

/// What is wrong after an increment; empty while all is well. @param bound of the law's residual
[[nodiscard]] std::string crush_trouble(const statics::CrushReport& report,
                                        const statics::CrushWorks& works, double bound);

}  // namespace rondo::study
