// SPDX-License-Identifier: BSD-3-Clause
/// @file  Ground that is small beside the elements of a body, which feels it between its nodes
/// but does not resolve it (docs/theory.md, 4.1).
#pragma once
#include <string>

#include "rondo/case/setup.hpp"

namespace rondo::study {

/// What to say of an obstacle that is shorter than the contact nodes are apart, else of a fillet
/// that is smaller; empty: there is none. Corners that the case has sharp are meant so.
[[nodiscard]] std::string small_ground(const Case& c, const Setup& s);

}  // namespace rondo::study
