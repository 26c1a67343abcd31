// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case with the files that it names, as the resources of an FMU.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "rondo/case/case.hpp"

namespace rondo::fmu {

/// Name in the folder of the resources, and contents.
using Resource = std::pair<std::string, std::string>;

/// case.toml; the mesh of its section, which its importer reads without any other program; the road
/// under a wheel in three dimensions.
/// @throws InputError, FileError: a file cannot be read, or a road is in more than one
[[nodiscard]] std::vector<Resource> packed_case(const study::Case& c);

}  // namespace rondo::fmu
