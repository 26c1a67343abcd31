// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo run --reduced`: a reduced wheel with exact contact (docs/reduced.md).
#pragma once
#include <memory>

#include "rondo/analysis/base/analysis.hpp"

namespace rondo::study {

/// @throws InputError: what a reduced wheel cannot do, or options that do not go with it
[[nodiscard]] std::unique_ptr<Analysis> make_wheel(const Case& c, const RunOptions& options);

/// Members of its run.json, besides dynamic_members().
std::vector<MemberText> wheel_members();

}  // namespace rondo::study
