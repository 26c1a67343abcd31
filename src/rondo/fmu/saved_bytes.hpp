// SPDX-License-Identifier: BSD-3-Clause
/// @file  A saved wheel as bytes, in this machine's number format, for another instance of the FMU.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondo/fmu/wheel.hpp"

namespace rondo::fmu {

/// @param owner identifies the FMU; saved_of() requires the same
[[nodiscard]] std::vector<char> bytes_of(const SavedWheel& saved, const std::string& owner);

/// @throws InputError: the bytes are of another FMU or version, or damaged
[[nodiscard]] SavedWheel saved_of(std::span<const char> bytes, const std::string& owner);

/// Number of characters of the hash that detects damage.
inline constexpr std::size_t hash_size = 32;
[[nodiscard]] std::string hash_of(std::span<const char> bytes);

}  // namespace rondo::fmu
