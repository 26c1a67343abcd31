// SPDX-License-Identifier: BSD-3-Clause
/// @file  Location of the resources of the FMU.
#pragma once
#include <filesystem>
#include <string>

namespace rondo::fmu {

/// Converts "file:///a%20b", "file:/a b" and "file://localhost/a b" to "/a b"; a path without
/// "file:" is unchanged. @throws InputError: another scheme or machine, or an invalid "%" code
[[nodiscard]] std::filesystem::path folder_of(const std::string& uri);

}  // namespace rondo::fmu
