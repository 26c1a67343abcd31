// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <optional>
#include <vector>

#include "rondo/analysis/build.hpp"
#include "rondo/analysis/crush_run.hpp"
#include "rondo/analysis/reduced_run.hpp"
#include "rondo/analysis/room.hpp"
#include "rondo/analysis/run_loop.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/resume.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/output/run_output.hpp"
#include "rondo/output/snapshot_schedule.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

Json describe(const Case& c, const Setup& setup) {
  Json j = describe_run(c, "dynamic", setup.model.n_nodes(), 2 * setup.model.free.size());
  if (c.mesh) j["mesh_file"] = as_utf8(c.mesh->file.string());
  j["bodies"] = count_bodies(setup.model);
  j["free_bodies"] = setup.model.free_bodies.size();
  j["operator"] = operator_name(setup.model.stiffness_operator);
  j["threads"] = setup.model.threads;
  j["critical_step"] = setup.critical.step;
  j["largest_frequency"] = setup.critical.omega;
  j["step"] = setup.model.dt;
  j["steps"] = setup.n_steps;
  j["dispatch"] = dispatch_level();
  return j;
}

double per_dof_step(const Setup& setup, const Loop& loop) {
  const double dofs = 2.0 * static_cast<double>(setup.model.free.size());
  return 1e9 * loop.wall_s / (dofs * static_cast<double>(std::max(1LL, loop.steps)));
}

Json describe(const OutputCost& cost) {
  return {{"wait_wall_s", cost.wait_wall_s},
          {"drain_wall_s", cost.drain_wall_s},
          {"write_wall_s", cost.write_wall_s},
          {"queue_full", cost.queue_full}};
}

void add_outcome(Json& j, const Setup& setup, const Loop& loop) {
  add_status(j, loop.status, loop.message);
  j["steps_done"] = loop.steps;
  j["end_time"] = static_cast<double>(loop.steps) * setup.model.dt;
  j["loop_wall_s"] = loop.wall_s;
  j["loop_cpu_s"] = loop.cpu_s;
  j["ns_per_dof_step"] = per_dof_step(setup, loop);
  j["energy_residual_relative"] = loop.balance.relative;
  j["energy_exchanged"] = loop.balance.exchanged;
  j["contact_residual_max"] = loop.contact.residual;
  j["penetration_max_m"] = loop.contact.penetration;
  j["contact"] = {{"steps_in_contact", loop.contact.contact_steps},
                  {"nodes_max", loop.contact.nodes_max},
                  {"free_velocity_max", loop.contact.free_velocity},
                  {"pairs_solved", loop.contact.pairs},
                  {"pairs_not_converged", loop.contact.pairs_not_converged},
                  {"clusters_solved", loop.contact.clusters},
                  {"clusters_not_converged", loop.contact.clusters_not_converged},
                  {"cluster_largest", loop.contact.cluster_largest},
                  {"cluster_iterations_max", loop.contact.cluster_iterations},
                  {"between_bodies_max", loop.contact.between_bodies},
                  {"problems_kept", loop.dumped}};
  j["peak_memory_bytes"] = peak_memory_bytes();
  j["snapshots"] = loop.snapshots;
  j["output"] = describe(loop.output);
}

RunReport report_of(const Setup& setup, const Loop& loop) {
  RunReport r;
  r.status = loop.status;
  r.message = loop.message;
  r.steps = loop.steps;
  r.end_time = static_cast<double>(loop.steps) * setup.model.dt;
  r.loop_wall_s = loop.wall_s;
  r.ns_per_dof_step = per_dof_step(setup, loop);
  r.energy_residual_relative = loop.balance.relative;
  r.contact_residual_max = loop.contact.residual;
  r.penetration_max_m = loop.contact.penetration;
  r.snapshots = loop.snapshots;
  return r;
}

std::vector<std::string> all_warnings(const Case& c, const Setup& setup,
                                      const SnapshotSchedule& schedule) {
  std::vector<std::string> warnings = c.warnings;
  warnings.insert(warnings.end(), setup.warnings.begin(), setup.warnings.end());
  if (setup.n_steps + 1 < c.output.snapshots)
    warnings.push_back(
        fmt::format("{} snapshots instead of {}: the run has {} steps, and each gives one "
                    "at the most",
                    schedule.steps.size(), c.output.snapshots, setup.n_steps));
  return warnings;
}

/// A run, begun or gone on with.
struct Run {
  const Case& c;
  const RunOptions& options;
  RunIdentity identity;
  std::optional<Checkpoint> from;
  SnapshotSchedule schedule;
  std::optional<ReducedRun> reduced;

  [[nodiscard]] Checkpoint* checkpoint() { return from ? &*from : nullptr; }
};

/// What is left after an error of files, and what can be done.
std::string what_is_kept(const Run& run, std::optional<RunOutput>& output) {
  const std::string kept = output ? output->kept() : "what was there is kept";
  const long long before = run.from ? run.from->state.step : 0;
  const long long step = output ? output->saved_step() : before;
  return step > 0 ? fmt::format("{}; --resume goes on from step {}", kept, step)
                  : kept + "; there is no checkpoint yet to go on from";
}

/// The loop with its output. A file that cannot be written ends the run: run.json says so, where
/// it can still be written itself.
Loop record(Run& run, Setup& setup, const Json& json) {
  std::optional<RunOutput> output;
  try {
    const RunOutput::Plan plan{run.options.directory, run.c, setup, run.schedule};
    output.emplace(plan, run.checkpoint());
    Loop loop = run_loop(
        {run.c, run.options, run.identity, run.checkpoint(), run.reduced ? &*run.reduced : nullptr},
        setup, *output);
    output->close();
    loop.snapshots = output->written();
    loop.output = output->cost();
    return loop;
  } catch (const FileError& error) {
    const FileError whole(error, what_is_kept(run, output));
    note_failure(run.options, json, whole);
    throw whole;
  } catch (const std::bad_alloc& error) {
    note_failure(run.options, json, error);
    throw;
  }
}

/// As the results directory keeps it: a run that became longer with all of its snapshots.
Case recorded_case(const Run& run) {
  Case c = run.c;
  if (run.from && run.schedule.steps.size() > static_cast<std::size_t>(c.output.snapshots))
    c.output.snapshots = static_cast<int>(run.schedule.steps.size());
  return c;
}

void add_resumed(const Run& run, Json& json) {
  if (!run.from) return;
  Json steps = Json::array();
  try {
    const Json before = io::read_json(run.options.directory / "run.json");
    const auto found = before.find("resumed_at_steps");
    if (found != before.end() && found->is_array()) steps = *found;
  } catch (const FileError&) {  // a lost run.json loses nothing else
  }
  steps.push_back(run.from->state.step);
  json["resumed_at_steps"] = steps;
}

RunReport nothing_to_do(const Checkpoint& k) {
  RunReport r;
  r.status = RunStatus::done;
  r.was_complete = true;
  r.steps = k.state.step;
  r.end_time = static_cast<double>(k.state.step) * k.identity.step;
  r.snapshots = k.files.snapshots;
  return r;
}

/// One of the time before the end, of a run that keeps none.
void drop_checkpoint(const RunOptions& options, RunStatus status) {
  std::error_code error;  // it does no harm
  if (!options.keeps_checkpoint && status == RunStatus::done)
    std::filesystem::remove(options.directory / checkpoint_name, error);
}

SnapshotSchedule fresh_schedule(const Case& c, const Setup& setup) {
  return snapshot_schedule(c.output, setup.model.dt, setup.n_steps);
}

Run make_run(const Case& c, const RunOptions& options, const Setup& setup) {
  Run run{c, options, identity_of(c, setup), std::nullopt, {}, std::nullopt};
  if (options.resume) run.from = find_checkpoint(run.identity, c, setup, options.directory);
  run.schedule = run.from ? run.from->schedule : fresh_schedule(c, setup);
  return run;
}

}  // namespace

RunReport run_case(const Case& c, const RunOptions& options) {
  if (c.analysis.kind == AnalysisKind::crush) return run_crush(c, options);
  const auto begin = Clock::now();
  static_cast<void>(dispatch_level());  // a wrong one is told before anything is built
  Setup setup = build(c, options.threads, options.shared);
  std::optional<ReducedRun> reduced;
  if (!options.reduced.empty()) reduced = prepare_reduced(c, options, setup);
  // Before anything is removed; a run that is gone on with needs what its checkpoint says.
  if (!options.resume) demand_disk(options, disk_needed(c, setup, fresh_schedule(c, setup)));
  if (options.resume) refuse_reduced(options.directory);
  const io::DirectoryLock lock = take_directory(c, options);
  Run run = make_run(c, options, setup);
  run.reduced = std::move(reduced);
  if (run.from && is_complete(*run.from, setup, options.directory)) return nothing_to_do(*run.from);
  const std::string other = warning_of_another_host(options.directory);
  if (!other.empty()) give_warnings({other}, options);
  if (options.resume) demand_disk(options, disk_needed(c, setup, run.schedule));
  give_warnings(all_warnings(c, setup, run.schedule), options);
  if (run.reduced) give_warnings(run.reduced->warnings, options);
  Json json = describe(c, setup);
  if (run.reduced) describe_reduced(*run.reduced, options, json);
  add_resumed(run, json);
  begin_files(recorded_case(run), options, json);

  const Loop loop = record(run, setup, json);
  add_outcome(json, setup, loop);
  if (run.reduced)
    add_figures(*run.reduced, static_cast<double>(loop.steps) * setup.model.dt, json);
  json["total_wall_s"] = std::chrono::duration<double>(Clock::now() - begin).count();
  io::write_json(options.directory / "run.json", json);
  drop_checkpoint(options, loop.status);
  RunReport report = report_of(setup, loop);
  report.resumable = !run.reduced;
  if (run.from) report.resumed_at = run.from->state.step;
  report.simulated_s = static_cast<double>(report.steps - report.resumed_at) * setup.model.dt;
  report.step_wall_s = run.reduced ? run.reduced->figures.wall_s : report.loop_wall_s;
  if (run.reduced) report.slowest_step = run.reduced->figures.slowest_step_s / setup.model.dt;
  return report;
}

}  // namespace rondo::study
