// SPDX-License-Identifier: BSD-3-Clause
/// @file  What part of a body sets its critical step, by the bound of each element (3.8a).
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Steps are those of the element bound, which is at most the critical step [s].
struct StepLimit {
  std::size_t cell = 0;        ///< the one with the smallest step
  Vec2 place;                  ///< place of its middle, in the undeformed body [m]
  std::string part;            ///< part that it is in: a layer of a disk, a surface
  std::string part_kind;       ///< "layer", "surface"
  double step = 0.0;           ///< with all elements
  double without_worst = 0.0;  ///< without the worst hundredth of them, one at the least
  double without_part = 0.0;   ///< without that part; 0: there is no other
};

/// @pre of a dynamic case, whose stiffness and prestress are there
StepLimit find_step_limit(const Case& c, const Setup& s);

/// Lines of `rondo check` on it: steps as factors of `step`, as the critical step is a larger one.
std::vector<Told> lines_of(const StepLimit& limit);

/// Lines of `rondo check` on the steps of a run, those on the limit among them.
std::vector<Told> step_lines(const Case& c, const Setup& s);

}  // namespace rondo::study
