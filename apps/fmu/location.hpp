// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where the resources of the FMU are.
#pragma once
#include <filesystem>
#include <string>

namespace rondo::fmu {

/// "file:///a%20b", "file:/a b" and "file://localhost/a b" to "/a b"; a path without "file:" as it
/// is. @throws InputError: it is of another scheme or machine, or has a "%" that codes no byte
[[nodiscard]] std::filesystem::path folder_of(const std::string& uri);

}  // namespace rondo::fmu
