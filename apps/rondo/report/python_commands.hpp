// SPDX-License-Identifier: BSD-3-Clause
/// @file  Commands implemented in the Python package: the program starts a Python that has the
/// required packages, whichever python3 is first in PATH (docs/python.md).
#pragma once
#include <string_view>

namespace CLI {
class App;
}

namespace rondo::app {

/// Adds them to the help of the program; the package prints their own help.
void add_python_commands(CLI::App& program);

[[nodiscard]] bool is_python_command(std::string_view name) noexcept;

/// Replaces this process by the Python program for the command argv[1], with its exit code.
/// @throws FileError: Python or the package is missing
[[noreturn]] void do_python_command(int argc, char** argv);

}  // namespace rondo::app
