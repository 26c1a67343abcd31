// SPDX-License-Identifier: BSD-3-Clause
/// @file  Identifies the program exactly, so that results of a different build are not reused.
#pragma once
#include <string>

namespace rondo {

/// Hash of the library modules that the program and the Python module are linked from; the build
/// writes it (cmake/modules_id.cmake).
extern const char* const modules_id;

/// Sets build_id(): modules_id, in programs that have it. Must be called before anything else.
void set_build_id(std::string id);

/// The identifier that was set, else the GNU build id that the linker gave the running program, in
/// hexadecimal; empty if it was linked without one.
[[nodiscard]] std::string build_id();

}  // namespace rondo
