// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo._core: the library for the package rondo, whose own classes and functions are what
/// users call (docs/python.md).
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <new>

#include "calls.hpp"
#include "commands.hpp"
#include "roads.hpp"
#include "rondo/core/build_id.hpp"
#include "rondo/core/build_record.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/limits/processors.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/core/version.hpp"
#include "rondo/output/run_files.hpp"
#include "simulation.hpp"

namespace {

namespace py = pybind11;

py::object error_class(const char* name) {
  return py::module_::import("rondo.data.errors").attr(name);
}

py::list faults_of(const rondo::InputError& error) {
  py::list faults;
  for (const rondo::Fault& f : error.faults()) {
    py::dict fault;
    fault["file"] = f.file;
    fault["line"] = f.line;
    fault["column"] = f.column;
    fault["key"] = f.key;
    fault["found"] = f.found;
    fault["message"] = f.message;
    fault["allowed"] = f.allowed;
    faults.append(fault);
  }
  return faults;
}

void raise(const py::object& type, const char* text) {
  PyErr_SetString(type.ptr(), text);
}

/// Raises exceptions of the library as errors of the package (docs/python.md, What can go wrong).
/// pybind11 requires a parameter by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const rondo::InputError& error) {
    const py::object type = error_class("InputError");
    PyErr_SetObject(type.ptr(), type(error.what(), faults_of(error)).ptr());
  } catch (const rondo::FileError& error) {
    raise(error_class("FileError"), error.what());
  } catch (const rondo::python::NumericalFailure& error) {
    raise(error_class("NumericalError"), error.what());
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The library of rondo; used through the package rondo.";
  rondo::set_build_id(rondo::modules_id);
  rondo::set_commit(rondo::built_commit, rondo::built_modified);
  rondo::work_alone_in_forks();
  rondo::use_allowed_processors();
  module.attr("version") = rondo::version;
  module.attr("build_options") = rondo::build_options;
  module.def("build_id", [] { return rondo::build_id(); });
  module.def("allowed_processors", rondo::allowed_processors);
  module.def("dispatch_level", [] { return rondo::study::dispatch_level(); });
  module.def("end_calls", rondo::python::end_calls);
  py::register_exception_translator(translate);
  rondo::python::add_commands(module);
  rondo::python::add_roads(module);
  rondo::python::add_simulation(module);
}
