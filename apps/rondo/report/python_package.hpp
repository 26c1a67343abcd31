// SPDX-License-Identifier: BSD-3-Clause
/// @file  The Python package that belongs to this program, and a Python that can run it.
#pragma once
#include <string>
#include <vector>

namespace rondo::app {

/// The parent of the folder `rondo` with the package: in the sources, beside an installed program,
/// or around the program in a wheel. @throws FileError: there is none
[[nodiscard]] std::string find_python_package();

/// A Python with numpy, h5py, matplotlib and Pillow: $RONDO_PYTHON, that of the package's
/// environment, the system's, or the one in PATH. @throws FileError: there is none
[[nodiscard]] std::string find_python(const std::string& package);

/// Replaces this process by `python -m rondo arguments`; returns only by an exception.
/// @throws FileError: it cannot be started
[[noreturn]] void become_python(const std::vector<std::string>& arguments);

/// Runs `python -m rondo arguments` and waits for it. @param silent  what it prints is discarded,
/// but not its errors. @return its exit code. @throws FileError: likewise
[[nodiscard]] int run_python(const std::vector<std::string>& arguments, bool silent);

}  // namespace rondo::app
