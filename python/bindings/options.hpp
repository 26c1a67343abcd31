// SPDX-License-Identifier: BSD-3-Clause
/// @file  Options that Python gives by name: what the command line checks of them is checked here.
#pragma once
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>

#include "rondo/core/error.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::python {

namespace py = pybind11;

/// Where it is given. @throws InputError: of another type
template <class T>
void take(const py::dict& given, const char* name, T& to) {
  if (!given.contains(name)) return;
  const py::object value = given[name];
  try {
    to = value.cast<T>();
  } catch (const py::cast_error&) {
    throw request_error(name, py::repr(value), "is of a wrong type",
                        "as docs/python.md and help() say");
  }
}

/// @throws InputError: out of bounds
template <class T>
void take_within(const py::dict& given, const char* name, T low, T high, T& to) {
  take(given, name, to);
  if (given.contains(name) && !(low <= to && to <= high))
    throw request_error(name, fmt::format("{}", to), "is out of bounds",
                        fmt::format("{} to {}", low, high));
}

/// Threads, directory and what goes with it, reduced models, modes.
inline void take_run(const py::dict& given, study::RunOptions& options) {
  take_within(given, "threads", 1, 1024, options.threads);
  take(given, "overwrite", options.overwrite);
  take(given, "resume", options.resume);
  if (options.overwrite && options.resume)
    throw request_error("resume", "", "goes on with what overwrite would remove", "one of both");
  take(given, "reduced", options.reduced);
  take(given, "step_factor", options.step_factor);
  take(given, "reduced_step", options.reduced_step);
  take(given, "snapshots", options.reduced_snapshots);
  for (const char* name : {"step_factor", "reduced_step", "snapshots"})
    if (given.contains(name) && options.reduced.empty())
      throw request_error(name, py::str(given[name]), "is of a reduced run",
                          "with reduced = a model of rondo.reduce");
  take(given, "modes_from", options.modes_from);
}

}  // namespace rondo::python
