// SPDX-License-Identifier: BSD-3-Clause
/// @file  The results of a run that takes no time.
#pragma once
#include <filesystem>

#include "rondo/case/case.hpp"

namespace rondo::fuzz {

study::Case tiny_case();

/// Eighteen nodes that touch the ground, three snapshots. Replaces what is in the directory.
void make_tiny_run(const std::filesystem::path& directory);

}  // namespace rondo::fuzz
