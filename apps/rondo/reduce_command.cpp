// SPDX-License-Identifier: BSD-3-Clause
#include "reduce_command.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <optional>
#include <string>

#include "exit_codes.hpp"
#include "progress.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/study/paper/validation_table.hpp"
#include "rondo/study/pod/pod_input.hpp"
#include "signals.hpp"

namespace rondo::app {
namespace {

void print_part(const study::ReducePart& part, double left) {
  fmt::print("{:<19}{} modes of {} snapshots; they leave {:.2e} of the energy, all modes {:.2e}\n",
             part.field, part.modes, part.snapshots, part.discarded, left);
}

void print_report(const study::ReduceRequest& request, const study::ReduceReport& r) {
  fmt::print("modes              {} for {} dofs\n", r.modes, r.dofs);
  print_part(r.displacement, r.displacement_left);
  print_part(r.velocity, r.velocity_left);
  fmt::print("contact points     {} {} round the disk{}\n", r.contact_points, r.contact,
             r.contact_step > 0.0 ? fmt::format(", one passed in {:.6g} s", r.contact_step) : "");
  if (r.patterns)
    fmt::print(
        "patterns           of {} snapshots with contact; they leave {:.2e} of the forces, "
        "{} sweeps\n",
        r.patterns->snapshots, r.patterns->left, r.patterns->sweeps);
  fmt::print("critical steps     {:.6g} s of the mesh, {:.6g} s of the modes (explicit)\n",
             r.full_critical_step, r.reduced_critical_step);
  fmt::print("time               {:.2f} s\n", r.wall_s);
  fmt::print("model              {} ({})\n", request.output.string(),
             readable_bytes(r.file_bytes));
}

void build(study::ReduceRequest& request, bool quiet) {
  request.warn = [](const std::string& text) { spdlog::warn(text); };
  const study::ReduceReport report = [&] {
    Progress progress("value");
    if (!quiet) request.progress = std::ref(progress);
    return study::run_reduce(request);
  }();
  print_report(request, report);
}

int validate(study::ValidationRequest& request, bool quiet) {
  request.warn = [](const std::string& text) { spdlog::warn(text); };
  request.stop = &stop_requested();
  request.before_loop = catch_stop_signals;
  std::optional<Progress> progress;
  request.begins = [&](const std::string& name) {
    spdlog::info("predicting {}", name);
    if (!quiet) progress.emplace("step");
  };
  request.progress = [&](long long done, long long total) {
    if (progress) (*progress)(done, total);
  };
  const study::ValidationReport report = study::validate(request);
  progress.reset();
  if (report.status() == study::RunStatus::interrupted) {
    spdlog::warn("interrupted; the model is kept, the same command without RUN validates it");
    return exit_interrupted;
  }
  fmt::print("{}", study::validation_text(report));
  fmt::print("validation         {}\n", report.directory.string());
  for (const study::Validated& run : report.runs)
    if (run.status == study::RunStatus::failed)
      spdlog::error("{}: {}; the results so far are in {}", run.full.string(), run.message,
                    run.reduced.string());
  return report.status() == study::RunStatus::done ? exit_done : exit_numerical;
}

}  // namespace

int reduce(ReduceArguments arguments) {
  study::ReduceRequest& request = arguments.request;
  study::ValidationRequest& validation = arguments.validation;
  if (arguments.quiet) spdlog::set_level(spdlog::level::warn);
  if (request.runs.empty() && validation.held_out.empty())
    throw request_error("RUN", "", "no runs to build a model from",
                               "results directories; or --validate RUN alone, for a model that "
                               "is there");
  validation.model = request.output;
  validation.built_from = request.runs;
  if (!validation.held_out.empty()) study::check_held_out(validation);
  if (!request.runs.empty()) build(request, arguments.quiet);
  return validation.held_out.empty() ? exit_done : validate(validation, arguments.quiet);
}

}  // namespace rondo::app
