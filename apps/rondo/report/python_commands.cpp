// SPDX-License-Identifier: BSD-3-Clause
#include "report/python_commands.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "report/python_package.hpp"

namespace rondo::app {
namespace {

struct PythonCommand {
  const char *name, *meaning;  ///< as in rondo/__main__.py
};

constexpr PythonCommand commands[] = {
    {"figures", "Draws the figures of a run, a sweep, modes or a study of the paper"},
    {"animate", "Makes a film of a run"},
    {"means", "Prints the mean forces of the ground on the body"},
    {"axes",
     "Writes the forces of a run or a sweep in the axes of ISO 8855, TYDEX, SAE or Pacejka"},
    {"psd", "Draws the power spectral density of a column of history.csv, and writes it as CSV"},
    {"converge", "Prints how the figures of a sweep converge with its mesh or its step"},
    {"wheel", "Draws height, speeds, slip, forces, torques and energies of a rim that forces move"},
    {"footprint",
     "Draws pressure, shear, slip and sticking in the contact of steady rolling, or of a wheel "
     "in three dimensions; friction, wear and flash temperature there"},
    {"traction", "Draws the longitudinal force of a sweep over slip: curves and carpets"},
    {"tyre", "Draws lateral force and aligning moment of a sweep over the slip angle"},
    {"campbell", "Draws the frequencies of a body over its spin"},
    {"validate", "Compares reduced runs with the full runs that they predict"},
    {"validation", "Draws the errors of reduced runs"},
    {"paper", "Runs the study of the paper: our results against those expected"},
    {"rig", "Tests a wheel on a tyre test rig: tables, tyre.tir, a report"},
};

}  // namespace

void add_python_commands(CLI::App& program) {
  for (const PythonCommand& command : commands)
    program.add_subcommand(command.name, command.meaning);
}

bool is_python_command(std::string_view name) noexcept {
  return std::ranges::any_of(commands,
                             [&](const PythonCommand& command) { return command.name == name; });
}

void do_python_command(int argc, char** argv) {
  become_python(std::vector<std::string>(argv + 1, argv + argc));
}

}  // namespace rondo::app
