// SPDX-License-Identifier: BSD-3-Clause
/// @file  A saved wheel as bytes, of this machine's numbers, for another instance of the same FMU.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "rondo/fmu/wheel.hpp"

namespace rondo::fmu {

/// @param owner what the bytes are of: read_bytes() asks for the same
[[nodiscard]] std::vector<char> bytes_of(const SavedWheel& saved, const std::string& owner);

/// @throws InputError: they are of another FMU or version, or damaged
[[nodiscard]] SavedWheel saved_of(std::span<const char> bytes, const std::string& owner);

}  // namespace rondo::fmu
