// SPDX-License-Identifier: BSD-3-Clause
/// @file  The Python package that belongs to this program, and a Python that can run it.
#pragma once
#include <string>
#include <vector>

namespace rondo::app {

/// Where the folder `rondo` with the package is: of the sources, beside an installed program, or
/// round the program in a wheel. @throws FileError where there is none
[[nodiscard]] std::string find_python_package();

/// A Python with numpy, h5py, matplotlib and Pillow: $RONDO_PYTHON, that of the environment with
/// the package, the system's, the one on PATH. @throws FileError where there is none
[[nodiscard]] std::string find_python(const std::string& package);

/// Becomes `python -m rondo arguments`: returns only by throwing.
/// @throws FileError where it cannot be started
[[noreturn]] void become_python(const std::vector<std::string>& arguments);

}  // namespace rondo::app
