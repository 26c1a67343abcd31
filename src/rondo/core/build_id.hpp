// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which program this is, to the bit: results of another one are not taken for its own.
#pragma once
#include <string>

namespace rondo {

/// Hash of the modules of the library that the program, and the module of Python, are linked from;
/// written by the build (cmake/modules_id.cmake).
extern const char* const modules_id;

/// What build_id() is from now on: modules_id, of those that have it. To be called first of all.
void set_build_id(std::string id);

/// What was set; else the linker's hash of the running program (its GNU build id), in hexadecimal;
/// empty where it was linked without.
[[nodiscard]] std::string build_id();

}  // namespace rondo
