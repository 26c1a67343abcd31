// SPDX-License-Identifier: BSD-3-Clause
/// @file  The analysis "inflation": equilibria of a wheel under growing loads (docs/tyre.md).
#pragma once
#include <memory>
#include <vector>

#include "rondo/analysis/base/analysis.hpp"

namespace rondo::study {

/// @throws InputError: the section cannot carry what the case asks for
[[nodiscard]] std::unique_ptr<Analysis> make_inflation(const Case& c, const RunOptions& options);

/// The members of run.json that only this analysis has.
[[nodiscard]] std::vector<MemberText> inflation_members();

}  // namespace rondo::study
