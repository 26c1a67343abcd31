// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <functional>

#include "default_directory.hpp"
#include "documents/documents.hpp"
#include "progress.hpp"
#include "report/axes_option.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/analysis/run.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/error.hpp"
#include "signals.hpp"

namespace rondo::app {
namespace {

void tell_balance(const study::RunReport& r) {
  spdlog::info(
      "energy balance closes to {:.1e} (bound {:.0e}), contact law to {:.1e}, largest penetration "
      "{:.2g} m",
      r.energy_residual_relative, r.energy_residual_bound, r.contact_residual_max,
      r.penetration_max_m);
  spdlog::info("largest strain {:.2g}, smallest J of an element {:.2g}", r.strain_max,
               r.jacobian_min);
}

int finish(const study::RunReport& r, const std::filesystem::path& directory, Telling& tell) {
  for (const std::string& warning : r.warnings) spdlog::warn(warning);
  switch (r.status) {
    case study::RunStatus::failed:
      spdlog::error("{}; the results so far are in {}", r.message, directory.string());
      return exit_numerical;
    case study::RunStatus::interrupted:
      warn_of_end(tell,
                  fmt::format("interrupted after {}; the results so far are in {}{}", r.reached,
                              directory.string(), r.resumable ? "; continue with --resume" : ""));
      return exit_interrupted;
    case study::RunStatus::done:
      break;
  }
  if (r.was_complete) {
    spdlog::info("{} has come to its end, {}: nothing to do; with a later time.end it continues",
                 directory.string(), r.reached);
    return exit_done;
  }
  if (r.resumed_at > 0) spdlog::info("resumed from step {}", r.resumed_at);
  if (r.ns_per_dof_step == 0.0)
    spdlog::info("{} in {:.2f} s", r.reached, r.loop_wall_s);
  else
    spdlog::info("{} in {:.2f} s ({:.1f} ns per dof and step)", r.reached, r.loop_wall_s,
                 r.ns_per_dof_step);
  if (r.energy_residual_bound > 0.0) tell_balance(r);
  for (const std::string& note : r.notes) spdlog::info(note);
  spdlog::info("{} snapshots in {}", r.snapshots, directory.string());
  return exit_done;
}

void print_limits(const study::CheckReport& r) {
  fmt::print("snapshots          {}\n", r.snapshots);
  fmt::print("memory             about {}\n", readable_bytes(r.memory_bytes));
  fmt::print("disk               about {}\n", readable_bytes(r.disk_bytes));
}

void print_check(const study::Case& c, const study::CheckReport& r) {
  fmt::print("title              {}\n", c.title);
  fmt::print("nodes              {} ({} elements, {} free dofs, {} contact nodes)\n", r.nodes,
             r.elements, r.dofs, r.candidates);
  if (study::may_be_free(c))
    fmt::print("bodies             {} ({} free)\n", r.bodies, r.free_bodies);
  fmt::print("wave speeds        {:.6g} m/s pressure, {:.6g} m/s shear\n", r.wave_speeds.pressure,
             r.wave_speeds.shear);
  for (const auto& [what, value] : r.lines) fmt::print("{:<18} {}\n", what, value);
  print_limits(r);
  if (r.seconds > 0.0)
    fmt::print("time               about {:.2g} s of stepping on {} thread{}\n", r.seconds,
               r.threads, r.threads == 1 ? "" : "s");
}

/// With --resume, the directory alone may be given, because it contains its case.
void complete(RunArguments& arguments) {
  std::error_code error;
  std::filesystem::path& into = arguments.options.directory;
  const std::filesystem::path given = arguments.case_file;
  if (std::filesystem::is_directory(given, error)) {
    if (!arguments.options.resume && std::filesystem::exists(given / "run.json", error))
      throw InputError(Fault{given.string(), 0, 0, "", "",
                             "is the results directory of a run, not a case file",
                             "--resume to continue it, or case.toml in it with another -o"});
    if (arguments.options.resume) {
      if (into.empty()) into = given;
      arguments.case_file = (given / "case.toml").string();
    }
  }
  if (into.empty())
    into = arguments.options.resume ? resumed_directory(arguments.case_file, "run.json")
                                    : default_directory(arguments.case_file);
}

/// Counts only this call: for a resumed run, from its checkpoint on.
void print_realtime_factor(const study::RunReport& r) {
  if (!(r.simulated_s > 0.0 && r.step_wall_s > 0.0)) {
    fmt::print("real time          no motion was computed\n");
    return;
  }
  fmt::print("real time          {:.4g} times: {:.6g} s of motion, {:.4g} s of steps{}\n",
             r.simulated_s / r.step_wall_s, r.simulated_s, r.step_wall_s,
             r.slowest_step > 0.0
                 ? fmt::format("; the slowest step took {:.3g} of its time", r.slowest_step)
                 : " and output");
}

}  // namespace

int run(RunArguments arguments, Telling& tell) {
  if (tell.quiet) spdlog::set_level(spdlog::level::warn);
  complete(arguments);
  study::RunOptions& options = arguments.options;
  const study::Case c = study::read_case(arguments.case_file, arguments.settings);
  demand_axes(c, arguments.axes);
  options.warn = [](const std::string& text) { spdlog::warn(text); };
  options.stop = &stop_requested();
  options.before_loop = catch_stop_signals;
  const study::RunReport report = [&] {
    Progress progress(study::type_of(c).unit);
    if (!tell.quiet) options.progress = std::ref(progress);
    return study::run_case(c, options);
  }();
  if (tell.json)
    tell.result = run_document(report, options.directory);
  else if (arguments.realtime_factor)
    print_realtime_factor(report);
  return write_axes(options.directory, arguments.axes, finish(report, options.directory, tell),
                    tell);
}

int check(const RunArguments& arguments, Telling& tell) {
  const study::Case c = study::read_case(arguments.case_file, arguments.settings);
  const study::CheckReport r =
      study::check_case(c, {.threads = arguments.options.threads, .run = &arguments.options});
  for (const std::string& warning : r.warnings) spdlog::warn(warning);
  if (tell.json)
    tell.result = check_document(c, r);
  else
    print_check(c, r);
  return exit_done;
}

}  // namespace rondo::app
