// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo report`: one HTML file of results, which the Python package makes
/// (docs/report.md).
#pragma once
#include <string>

namespace CLI {
class App;
}

namespace rondo::app {

struct ReportArguments {
  std::string results;  ///< directory of a run, a sweep, a POD, the paper's study
  std::string file;     ///< empty: report.html in that directory
};

/// Adds the command; the arguments are filled when it is parsed, and must outlive it.
CLI::App* add_report(CLI::App& program, ReportArguments& arguments);

/// Becomes the Python program that does it; its exit code is that of the command.
/// @throws FileError where Python or the package is missing
[[noreturn]] int report(const ReportArguments& arguments);

}  // namespace rondo::app
