// SPDX-License-Identifier: BSD-3-Clause
/// @file  Commands that the Python package does: the program starts the Python that has what they
/// need, whichever python3 is first on the path (docs/python.md).
#pragma once
#include <string_view>

namespace CLI {
class App;
}

namespace rondo::app {

/// For the help of the program; their own is the package's.
void add_python_commands(CLI::App& program);

[[nodiscard]] bool is_python_command(std::string_view name) noexcept;

/// Becomes the Python program that does the command argv[1]; its exit code is that of the command.
/// @throws FileError where Python or the package is missing
[[noreturn]] void do_python_command(int argc, char** argv);

}  // namespace rondo::app
