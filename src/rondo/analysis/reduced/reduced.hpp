// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo run --reduced`: a case on the modes of a reduced model instead of its mesh
/// (docs/reduced.md, 7).
#pragma once
#include <memory>

#include "rondo/analysis/base/analysis.hpp"

namespace rondo::study {

/// @throws InputError: no such file, another body, what a reduced run cannot do; FileError
[[nodiscard]] std::unique_ptr<Analysis> make_reduced(const Case& c, const RunOptions& options);

/// Members of a reduced run in run.json, besides dynamic_members().
std::vector<MemberText> reduced_members();

}  // namespace rondo::study
