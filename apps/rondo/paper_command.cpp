// SPDX-License-Identifier: BSD-3-Clause
#include "paper_command.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>

#include "exit_codes.hpp"
#include "job_progress.hpp"
#include "rondo/study/paper/paper.hpp"
#include "signals.hpp"

namespace rondo::app {
namespace {

using study::PaperRow;

std::string bound(const PaperRow& row) {
  if (row.comparison == study::Comparison::within)
    return fmt::format("{:.6g} ± {:.2g}", row.expected, row.tolerance);
  return fmt::format("{} {:.6g}", study::name_of(row.comparison), row.expected);
}

void print_table(const std::vector<PaperRow>& rows) {
  int figure = 0;
  for (const PaperRow& row : rows) {
    if (row.figure != figure)
      fmt::print("{}figure {}{:66}{:>14}   expected\n", figure == 0 ? "" : "\n", row.figure, "",
                 "ours");
    figure = row.figure;
    const std::string unit = row.unit == "1" ? "" : " [" + row.unit + "]";
    fmt::print("{} {:<69}{:>14.6g}   {}\n", study::passes(row) ? "    " : "NOT ",
               row.quantity + unit, row.ours, bound(row));
  }
}

int finish(const study::PaperReport& report, const std::string& directory) {
  if (report.status == study::RunStatus::interrupted) {
    spdlog::warn("interrupted with {} of {} jobs done; the same command goes on",
                 report.done + report.kept, report.jobs);
    return exit_interrupted;
  }
  if (report.rows.empty()) {
    spdlog::error("{}; what is done stays in {}, and the same command goes on", report.message,
                  directory);
    return report.code;
  }
  print_table(report.rows);
  const auto passed = std::count_if(report.rows.begin(), report.rows.end(), study::passes);
  fmt::print("\n{} of {} as expected, in {:.1f} s; data and paper.json in {}\n", passed,
             report.rows.size(), report.wall_s, directory);
  fmt::print(
      "figures: python3 -m rondo figures {} (PYTHONPATH=python from the project's root, where\n"
      "the package is not installed: docs/python.md)\n",
      directory);
  if (report.status == study::RunStatus::done) return exit_done;
  spdlog::error("{}", report.message);
  return report.code;
}

}  // namespace

int paper(const PaperArguments& arguments) {
  if (arguments.quiet) spdlog::set_level(spdlog::level::warn);
  study::PaperRequest request;
  const std::string directory = !arguments.directory.empty() ? arguments.directory
                                : arguments.quick            ? "paper-quick"
                                                             : "paper";
  request.directory = directory;
  request.quick = arguments.quick;
  request.overwrite = arguments.overwrite;
  request.at_once = arguments.jobs;
  request.stop = &stop_requested();
  std::optional<JobProgress> progress;
  request.begin = [&](std::span<const study::Job> jobs, std::size_t kept) {
    if (kept > 0)
      spdlog::info("{} of {} jobs are there already and kept", kept, kept + jobs.size());
    catch_stop_signals();
    if (!arguments.quiet) progress.emplace(jobs);
  };
  request.ended = [&](std::size_t job, const study::JobOutcome& outcome) {
    if (progress) progress->ended(job, outcome);
  };
  request.progress = [&](const study::JobsProgress& p) {
    if (progress) progress->draw(p);
  };
  const study::PaperReport report = study::run_paper(request);
  progress.reset();
  return finish(report, directory);
}

}  // namespace rondo::app
