// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_command.hpp"

#include <CLI/CLI.hpp>

#include "options.hpp"
#include "report/python_package.hpp"

namespace rondo::app {

CLI::App* add_report(CLI::App& program, ReportArguments& arguments) {
  CLI::App* report = program.add_subcommand(
      "report",
      "Writes one HTML file of results that needs no network: moving body, curves, health");
  report
      ->add_option("results", arguments.results,
                   "Directory of a run, a sweep, a POD or the study of the paper")
      ->required();
  report
      ->add_option("-o,--output", arguments.file,
                   "File that ends in .html; report.html in the directory if left out")
      ->check(refuse_empty);
  report->footer(
      "Example:\n  rondo report results/ledge -o ledge.html\n"
      "Needs Python with numpy, h5py and matplotlib (scripts/setup.sh); docs/report.md.\n"
      "Exit codes: 0 done, 2 wrong input, 4 files, or no Python, 130 interrupted.");
  return report;
}

int report(const ReportArguments& arguments) {
  std::vector<std::string> words{"report"};
  if (!arguments.file.empty()) words.insert(words.end(), {"-o", arguments.file});
  words.insert(words.end(), {"--", arguments.results});
  become_python(words);
}

}  // namespace rondo::app
