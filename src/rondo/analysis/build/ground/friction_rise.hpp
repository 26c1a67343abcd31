// SPDX-License-Identifier: BSD-3-Clause
/// @file  Friction that rises with the slip more steeply than the step can follow, before a run
/// (docs/roads.md, section 6; docs/theory.md, 4.3e).
#pragma once
#include "rondo/case/setup.hpp"
#include "rondo/model/stability/friction_step.hpp"

namespace rondo::study {

/// What the elements of a body take of the stability of its steps.
[[nodiscard]] dynamics::ElementLimit elements_of(const Setup& s) noexcept;

/// dynamics::friction_step(), rounded down to two digits. @param rate κ over the step     [1/s]
[[nodiscard]] double friction_step_of(const Setup& s, double rate) noexcept;

/// Adds a figure on friction that rises with the slip, and a warning if it vanishes at rest and the
/// estimated pressure is beyond what any contact node of this mass follows.
void tell_friction_rise(const Case& c, Setup& s);

}  // namespace rondo::study
