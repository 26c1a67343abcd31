// SPDX-License-Identifier: BSD-3-Clause
/// @file  Quasi-static crush onto flat ground, increment by increment (docs/theory.md, 6.4). In the
/// place of time stands the load parameter k/increments, above 1 while a slide is drawn that is a
/// number.
#pragma once
#include <memory>

#include "rondo/analysis/base/analysis.hpp"

namespace rondo::study {

/// @pre c is a crush. @throws InputError
[[nodiscard]] std::unique_ptr<Analysis> make_crush(const Case& c, const RunOptions& options);

/// Members of a crush in run.json, besides shared_members(), rubber_members() and latin_members().
std::vector<MemberText> crush_members();

}  // namespace rondo::study
