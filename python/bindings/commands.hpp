// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the commands of the program do, as functions: run, modes, pod, reduce, sweep,
/// and a case solved into memory.
#pragma once
#include <pybind11/pybind11.h>

namespace rondo::python {

void add_commands(pybind11::module_& module);

}  // namespace rondo::python
