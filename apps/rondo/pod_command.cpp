// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <string>

#include "documents/documents.hpp"
#include "progress.hpp"
#include "rondo/core/bytes.hpp"

namespace rondo::app {
namespace {

std::string count_text(long long modes) {
  return modes < 0 ? "more than found" : fmt::to_string(modes);
}

std::string times(const study::PodReport& r, double from, double to) {
  return r.time_unit == "s" ? fmt::format("t = {:.6g} to {:.6g} s", from, to)
                            : fmt::format("{:.6g} to {:.6g} of the load", from, to);
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

void print_runs(const study::PodReport& r) {
  std::string shares;
  for (const study::PodCount& count : r.counts) shares += fmt::format("{:.0e} / ", count.discarded);
  fmt::print("errors by run      with the modes for {}all kept\n", shares);
  for (const study::PodRun& run : r.runs) {
    std::string errors;
    for (const auto& error : run.count_errors) errors += (error ? percent(*error) : "-") + " / ";
    fmt::print("  {}: {}{} ({} snapshots, {}, {} of the energy)\n", run.directory.string(), errors,
               percent(run.error), run.snapshots, times(r, run.from, run.to),
               percent(run.energy_share));
  }
}

void print_report(const study::PodRequest& q, const study::PodReport& r) {
  fmt::print("field              {} ({}), {} frame, weight {}\n", q.field, r.unit,
             q.frame == "rectified" ? q.frame : "co-rotating", r.weight);
  fmt::print("snapshots          {} of {} numbers, {}\n", r.snapshots, r.rows,
             r.runs.size() > 1 ? fmt::format("from {} runs", r.runs.size())
                               : times(r, r.runs.front().from, r.runs.front().to));
  fmt::print("method             {}, {:.2f} s, {}\n", r.method, r.wall_s,
             readable_bytes(r.peak_memory));
  fmt::print("rank               {}{} (first singular value {:.6g}{})\n",
             r.rank_is_known ? "" : "at least ", r.rank, r.sigma_1,
             r.sigma_bound > 0.0 ? fmt::format(", all right to {:.1e} of it", r.sigma_bound) : "");
  for (const study::PodCount& count : r.counts)
    fmt::print("modes for {:.0e}    {}\n", count.discarded, count_text(count.modes));
  fmt::print("modes kept         {}\n", r.modes);
  fmt::print("worst snapshot     {} of its norm lost, {}{}\n", percent(r.worst_error),
             r.time_unit == "s" ? fmt::format("t = {:.6g} s", r.worst_time)
                                : fmt::format("at {:.6g} of the load", r.worst_time),
             r.runs.size() > 1 ? ", " + r.worst_run.string() : "");
  fmt::print("error identity     |S - PP'WS|^2 = {:.6e} of the energy, {} {:.6e}: {:.1e} apart\n",
             r.residual, r.lost > 0.0 ? "with what was cut at most" : "discarded", r.tail,
             r.difference);
  if (r.runs.size() > 1) print_runs(r);
  fmt::print("files              {}\n", r.directory.string());
}

}  // namespace

int pod(study::PodRequest request, Telling& tell) {
  if (tell.quiet) spdlog::set_level(spdlog::level::warn);
  request.warn = [](const std::string& text) { spdlog::warn(text); };
  if (!tell.quiet) request.say = [](const std::string& text) { spdlog::info(text); };
  const study::PodReport report = [&] {
    Progress progress("value");
    if (!tell.quiet) request.progress = std::ref(progress);
    return study::run_pod(request);
  }();
  if (tell.json)
    tell.result = pod_document(request, report);
  else
    print_report(request, report);
  if (report.trouble.empty()) return exit_done;
  spdlog::error("{}; the results are in {}", report.trouble, report.directory.string());
  return exit_numerical;
}

}  // namespace rondo::app
