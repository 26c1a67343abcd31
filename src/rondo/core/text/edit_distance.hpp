// SPDX-License-Identifier: BSD-3-Clause
/// @file  Distance between two names, for messages that suggest the name probably meant.
#pragma once
#include <cstddef>
#include <string_view>

namespace rondo {

/// Damerau-Levenshtein distance (insert, delete, replace, swap two neighbours), ignoring case.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace rondo
