// SPDX-License-Identifier: BSD-3-Clause
/// @file  What `rondo check` tells of viscous materials (docs/rolling-resistance.md).
#pragma once
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Loss factor and stiffness over frequency of each material with branches at small strain or with
/// a loss factor, and how well its branches meet that.
[[nodiscard]] std::vector<Told> viscosity_lines(const Case& c);

}  // namespace rondo::study
