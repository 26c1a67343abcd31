// SPDX-License-Identifier: BSD-3-Clause
/// @file  The features of the table of steps (model/steps/step_table.hpp) that a case requests: the
/// key of each, and what to write instead.
#pragma once
#include <string>
#include <string_view>

#include "rondo/case/case.hpp"
#include "rondo/model/steps/step_table.hpp"

namespace rondo::study {

struct CaseFeature {
  dynamics::Features of;
  std::string_view key;      ///< key at which a refusal is reported
  std::string_view without;  ///< what to write for a model without this feature
  bool (*is_in)(const Case& c);
};

/// The features that the case requests. Whether a body of a mesh is free, and whether a fillet is
/// small compared with the elements, is known only from the model (dynamics::features_of). Faulty
/// input counts as absent.
[[nodiscard]] dynamics::Features features_of(const Case& c);

/// The row of a feature that the case or its model has; of several, that of the lowest.
[[nodiscard]] const CaseFeature& row_of(const Case& c, dynamics::Features feature);

/// "no [rim]; or time.scheme = ...": alternatives to what the limit
/// refuses. @pre it is a refusal of two features
[[nodiscard]] std::string instead_of(const Case& c, const dynamics::Limit& refusal);

/// The reason why K cannot be applied sector by sector; empty if it can.
[[nodiscard]] std::string_view why_not_cyclic(const Case& c);

}  // namespace rondo::study
