// SPDX-License-Identifier: BSD-3-Clause
/// @file  Words about ground whose corners are sharp for the nodes that come there, for steps that
/// know contact at nodes alone.
#pragma once
#include <string>

#include "rondo/case/case.hpp"
#include "rondo/model/model.hpp"

namespace rondo::study {

struct CornerWords {
  std::string corners;  ///< with their sizes
  std::string instead;  ///< the fillet that nodes resolve
};

/// @pre has_sharp_corners(model)
[[nodiscard]] CornerWords corner_words(const Case& c, const dynamics::Model& model);

}  // namespace rondo::study
