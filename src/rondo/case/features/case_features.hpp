// SPDX-License-Identifier: BSD-3-Clause
/// @file  The features of the table of steps (model/steps/step_table.hpp) as a case has them: the
/// key that asks for each, and what to write instead.
#pragma once
#include <string>
#include <string_view>

#include "rondo/case/case.hpp"
#include "rondo/model/steps/step_table.hpp"

namespace rondo::study {

struct CaseFeature {
  dynamics::Features of;
  std::string_view key;      ///< that a refusal is told at
  std::string_view without;  ///< what to write for a model that has not this feature
  bool (*is_in)(const Case& c);
};

/// What the case asks for; whether some body of a mesh is free, and whether a fillet is small
/// beside the elements, only the model tells (dynamics::features_of). What is at fault counts as
/// not there.
[[nodiscard]] dynamics::Features features_of(const Case& c);

/// The row of one feature, which the case or its model has.
[[nodiscard]] const CaseFeature& row_of(const Case& c, dynamics::Features feature);

/// "no [rim]: a rim that follows [motion]; or time.scheme = ...": what may stand instead of what
/// the limit refuses. @pre it is a refusal: of two features
[[nodiscard]] std::string instead_of(const Case& c, const dynamics::Limit& refusal);

/// Why K cannot be taken sector by sector; empty where it can.
[[nodiscard]] std::string_view why_not_cyclic(const Case& c);

}  // namespace rondo::study
