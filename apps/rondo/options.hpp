// SPDX-License-Identifier: BSD-3-Clause
/// @file  The options of each command, and its help.
#pragma once
#include <string>

#include "commands.hpp"

namespace CLI {
class App;
}

namespace rondo::app {

/// Fault of an option whose value is empty, e.g. because a shell variable is not set.
inline std::string refuse_empty(const std::string& text) {
  return text.empty() ? "is empty: a name is to follow, or the option is to be left out" : "";
}

// These functions add a command to the program. The arguments are filled by parsing and must
// outlive it.
CLI::App* add_run(CLI::App& program, RunArguments& arguments, Telling& tell);
CLI::App* add_check(CLI::App& program, RunArguments& arguments, Telling& tell);
CLI::App* add_reduce(CLI::App& program, study::ReduceRequest& r, Telling& tell);
CLI::App* add_fmu(CLI::App& program, study::FmuRequest& r, Telling& tell);
CLI::App* add_pod(CLI::App& program, study::PodRequest& r, Telling& tell);
CLI::App* add_modes(CLI::App& program, ModesArguments& arguments, Telling& tell);
CLI::App* add_matrices(CLI::App& program, MatricesArguments& arguments, Telling& tell);
CLI::App* add_schema(CLI::App& program, std::string& of);
CLI::App* add_sweep(CLI::App& program, SweepArguments& arguments, Telling& tell);

}  // namespace rondo::app
