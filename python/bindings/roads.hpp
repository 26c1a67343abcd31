// SPDX-License-Identifier: BSD-3-Clause
/// @file  road::Road and its surfaces for Python: rondo.files.read_crg().
#pragma once
#include <pybind11/pybind11.h>

namespace rondo::python {

void add_roads(pybind11::module_& module);

}  // namespace rondo::python
