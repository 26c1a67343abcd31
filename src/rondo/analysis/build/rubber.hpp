// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rubber at finite strain in what a case is built into (docs/rubber.md).
#pragma once
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Gives the model the forces of rubber instead of those of K, where some part is rubber.
/// @pre bodies, masses and K of small strains are there. @throws InputError: β on a free body of
/// rubber
void add_rubber(const Case& c, Setup& s);

/// Branches that relax within a step of a full run are refused, within four warned of. Reduced
/// wheels take any. @pre the step is chosen
void check_branches(const Case& c, Setup& s);

/// Law, moduli and branches of each rubber, for `rondo check`. @param step explicit; 0: none [s]
[[nodiscard]] std::vector<Told> rubber_lines(const Case& c, double step);

}  // namespace rondo::study
