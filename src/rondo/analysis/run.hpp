// SPDX-License-Identifier: BSD-3-Clause
/// @file  One run: from a case to a results directory (docs/results.md).
#pragma once
#include "rondo/output/run_options.hpp"

namespace rondo::study {

class Analysis;

/// @throws InputError (the case cannot run; nothing is left behind), FileError.
[[nodiscard]] RunReport run_case(const Case& c, const RunOptions& options);

/// Runs an analysis that is made already. @param c what it was made of, kept as case.toml
[[nodiscard]] RunReport run_analysis(Analysis& analysis, const Case& c, const RunOptions& options);

}  // namespace rondo::study
