// SPDX-License-Identifier: BSD-3-Clause
/// @file  A saved wheel as bytes, of this machine's numbers, for another instance of the same FMU.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rondo/fmu/wheel.hpp"

namespace rondo::fmu {

/// @param owner what the bytes are of: read_bytes() asks for the same
[[nodiscard]] std::vector<char> bytes_of(const SavedWheel& saved, const std::string& owner);

/// @throws InputError: they are of another FMU or version, or damaged
[[nodiscard]] SavedWheel saved_of(std::span<const char> bytes, const std::string& owner);

/// Of bytes, against damage: so many characters.
inline constexpr std::size_t hash_size = 32;
[[nodiscard]] std::string hash_of(std::span<const char> bytes);

}  // namespace rondo::fmu
