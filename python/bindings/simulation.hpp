// SPDX-License-Identifier: BSD-3-Clause
/// @file  study::Simulation for Python: its steps go without the interpreter's lock.
#pragma once
#include <pybind11/pybind11.h>

namespace rondo::python {

void add_simulation(pybind11::module_& module);

}  // namespace rondo::python
