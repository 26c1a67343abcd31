// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo report`: the Python package makes one HTML file of results
/// (docs/report.md).
#pragma once
#include <string>

namespace CLI {
class App;
}

namespace rondo::app {

struct ReportArguments {
  std::string results;  ///< directory of a run, a sweep, a POD or the paper's study
  std::string file;     ///< empty: report.html in that directory
};

/// Adds the command. The arguments are filled by parsing and must outlive it.
CLI::App* add_report(CLI::App& program, ReportArguments& arguments);

/// Replaces this process by the Python program, whose exit code is that of the command.
/// @throws FileError: Python or the package is missing
[[noreturn]] int report(const ReportArguments& arguments);

}  // namespace rondo::app
