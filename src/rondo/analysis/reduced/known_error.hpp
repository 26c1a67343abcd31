// SPDX-License-Identifier: BSD-3-Clause
/// @file  An error in run.json.
#pragma once
#include <cmath>

#include "rondo/case/schema/members.hpp"

namespace rondo::study {

/// Null where there is next to none of what the error is of.
inline Json known(double error) {
  return std::isnan(error) ? Json() : Json(error);
}

}  // namespace rondo::study
