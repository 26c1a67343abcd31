// SPDX-License-Identifier: BSD-3-Clause
/// @file  --axes of `rondo run` and `rondo sweep`: at their end the Python package writes the
/// forces in other axes, as `rondo axes` does (docs/conventions.md).
#pragma once
#include <filesystem>
#include <string>

#include "commands.hpp"

namespace CLI {
class App;
}

namespace rondo::app {

/// Adds the option. `axes` is filled by parsing and must outlive the command.
void add_axes(CLI::App& command, std::string& axes);

/// What can be known before the run starts. @param axes  empty: nothing is asked for
/// @throws InputError: forces of this case have no other axes; FileError: there is no Python
void demand_axes(const study::Case& c, const std::string& axes);
/// Does this for a sweep, and makes the sweep refuse members whose forces have no other axes.
void demand_axes(SweepArguments& arguments);

/// The table of a run or a sweep that has ended. @param code  its exit code
/// @return that code if it is not 0, else that of `rondo axes`
int write_axes(const std::filesystem::path& directory, const std::string& axes, int code,
               const Telling& tell);

}  // namespace rondo::app
