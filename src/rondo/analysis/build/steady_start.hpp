// SPDX-License-Identifier: BSD-3-Clause
/// @file  A start in the state that steady rolling settles in (docs/theory.md, 11.5).
#pragma once
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/fem/sector_stiffness.hpp"

namespace rondo::study {

/// Fills u_0, v_0 and v_{1/2} of the motion at t = 0. @pre check_steady_start() has nothing to say,
/// and the step is chosen. @throws InputError: nothing touches, or no state was found
void set_steady_rolling(const Case& c, Setup& s);

/// Rows of a sector whose nodes may touch the ground.
template <int C>
[[nodiscard]] std::vector<int> candidate_rows(const mesh::Mesh& mesh,
                                              const fem::SectorBlocks<C>& sector);

/// (n_local) What the pressures at t = 0 do to the rows of every sector, in its frame; empty: there
/// are none. @pre they are the same on all sectors                                        [N/m]
[[nodiscard]] std::vector<Vec2> sector_load(const dynamics::Model& model,
                                            const fem::SectorStiffness& sector);

}  // namespace rondo::study
