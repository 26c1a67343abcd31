// SPDX-License-Identifier: BSD-3-Clause
/// @file  The run of a crush, behind run_case.
#pragma once
#include "rondo/study/run.hpp"

namespace rondo::study {

/// As run_case. @pre c is a crush
[[nodiscard]] RunReport run_crush(const Case& c, const RunOptions& options);

}  // namespace rondo::study
