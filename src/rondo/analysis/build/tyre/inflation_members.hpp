// SPDX-License-Identifier: BSD-3-Clause
/// @file  The inflated state in run.json and in `rondo check`.
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/build/tyre/inflated_wheel.hpp"
#include "rondo/case/schema/members.hpp"
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// The member `inflation`.
void add_inflation(const InflationFigures& figures, Json& json);
[[nodiscard]] std::vector<MemberText> inflated_members();

/// Lines of `rondo check`.
[[nodiscard]] std::vector<Told> told_of(const InflationFigures& figures);

}  // namespace rondo::study
