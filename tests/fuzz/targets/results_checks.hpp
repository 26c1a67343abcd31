// SPDX-License-Identifier: BSD-3-Clause
/// @file  What is done with a results directory: all its fields, a POD of them.
#pragma once
#include <cstdint>
#include <filesystem>

namespace rondo::fuzz {

/// @param choice chooses field, frame, and seldom a POD with all its files
void check_results(const std::filesystem::path& run, std::uint32_t choice);

}  // namespace rondo::fuzz
