// SPDX-License-Identifier: BSD-3-Clause
/// @file  Options that Python gives by name, by the library's table of options.
#pragma once
#include <pybind11/pybind11.h>

#include "rondo/study/options/options.hpp"

namespace rondo::python {

namespace py = pybind11;

/// Fills the requests that options belong to from the arguments that are given in Python, and
/// checks what the command line checks. @throws InputError: of another type, out of bounds, beside
/// or without another option
void take_options(const py::dict& given, const study::Options& options);

}  // namespace rondo::python
