// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <optional>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/loop.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/checkpoint.hpp"
#include "rondo/output/resume.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// A run in its directory, begun or gone on with.
struct Run {
  const Case& c;
  const RunOptions& options;
  Analysis& analysis;
  RecordPlan plan;
  const Checkpoint* from = nullptr;
};

void demand_disk_of(const Run& run) {
  demand_disk(run.options, disk_needed(run.plan, run.analysis.resumable() != nullptr));
}

/// What is left after an error of files, and what can be done.
std::string what_is_kept(const Run& run, std::optional<Recorder>& recorder) {
  const std::string kept = recorder ? recorder->kept() : "what was there is kept";
  if (!run.analysis.resumable()) return kept;
  const long long before = run.from ? run.from->state.step : 0;
  const long long step = recorder ? recorder->saved_step() : before;
  return step > 0 ? fmt::format("{}; --resume resumes from step {}", kept, step)
                  : kept + "; there is no checkpoint yet to resume from";
}

/// The loop with its output. A file that cannot be written ends the run: run.json says so, where
/// it can still be written itself.
Loop record(Run& run, const Json& json) {
  std::optional<Recorder> recorder;
  try {
    recorder.emplace(run.options.directory, run.plan, run.from);
    Loop loop = run_loop({run.analysis, run.options, run.c.output.checkpoint_interval, run.from},
                         *recorder);
    recorder->close();
    loop.snapshots = recorder->written();
    loop.last_time = recorder->last_time();
    loop.output = recorder->cost();
    return loop;
  } catch (const FileError& error) {
    const FileError whole(error, what_is_kept(run, recorder));
    note_failure(run.options, json, whole);
    throw whole;
  } catch (const std::bad_alloc& error) {
    note_failure(run.options, json, error);
    throw;
  }
}

/// An array of the run.json of a run that is resumed; empty where there is none.
Json array_before(const Run& run, const char* key) {
  if (!run.from) return Json::array();
  try {
    const Json before = io::read_json(run.options.directory / "run.json");
    const auto found = before.find(key);
    if (found != before.end() && found->is_array()) return *found;
  } catch (const FileError&) {  // a lost run.json loses nothing else
  }
  return Json::array();
}

/// Those before a checkpoint stay; what is said again at the start stands there once.
void add_warnings(const Run& run, Json& json) {
  Json all = array_before(run, "warnings");
  for (const std::string& warning : run.analysis.warnings())
    if (std::find(all.begin(), all.end(), Json(warning)) == all.end()) all.push_back(warning);
  json["warnings"] = std::move(all);
}

void add_resumed(const Run& run, Json& json) {
  if (!run.from) return;
  Json steps = array_before(run, "resumed_at_steps");
  steps.push_back(run.from->state.step);
  json["resumed_at_steps"] = std::move(steps);
}

/// The run has come to its end and its files are closed.
bool is_complete(const Checkpoint& k, const std::filesystem::path& directory) {
  try {
    return k.is_at_end && text_in(io::read_json(directory / "run.json"), "status") == "done";
  } catch (const FileError&) {
    return false;
  }
}

RunReport nothing_to_do(const Checkpoint& k) {
  RunReport r;
  r.status = RunStatus::done;
  r.was_complete = true;
  r.steps = k.state.step;
  r.end_time = static_cast<double>(k.state.step) * k.identity.step;
  r.reached = fmt::format("{} steps to t = {:.6g} s", r.steps, r.end_time);
  r.snapshots = k.files.snapshots;
  return r;
}

/// One of the time before the end, of a run that keeps none.
void drop_checkpoint(const RunOptions& options, RunStatus status) {
  std::error_code error;  // it does no harm
  if (!options.keeps_checkpoint && status == RunStatus::done)
    std::filesystem::remove(options.directory / checkpoint_name, error);
}

Json describe(const Run& run) {
  Json json = describe_run(run.c, run.plan.results.words.analysis);
  json["resumable"] = run.analysis.resumable() != nullptr;
  run.analysis.describe(json);
  json["columns"] = Json::array();
  for (const ColumnLabel& column : run.plan.columns)
    json["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  add_warnings(run, json);
  add_resumed(run, json);
  return json;
}

RunReport report_of(const Run& run, const Loop& loop) {
  RunReport r;
  r.status = loop.status;
  r.message = loop.message;
  r.resumable = run.analysis.resumable() != nullptr;
  r.resumed_at = run.from ? run.from->state.step : 0;
  r.loop_wall_s = loop.wall_s;
  r.snapshots = loop.snapshots;
  return r;
}

void add_outcome(const Loop& loop, Json& j) {
  add_status(j, loop.status, loop.message);
  j["loop_wall_s"] = loop.wall_s;
  j["loop_cpu_s"] = loop.cpu_s;
  j["peak_memory_bytes"] = peak_memory_bytes();
  j["snapshots"] = loop.snapshots;
  j["last_time"] = loop.last_time;
  j["output"] = {{"wait_wall_s", loop.output.wait_wall_s},
                 {"drain_wall_s", loop.output.drain_wall_s},
                 {"write_wall_s", loop.output.write_wall_s},
                 {"queue_full", loop.output.queue_full}};
}

/// @param begin where the time that it takes in all is counted from
RunReport run_from(Clock::time_point begin, Analysis& analysis, const Case& c,
                   const RunOptions& options) {
  Run run{c, options, analysis, analysis.record_plan()};
  // Before anything is removed; a run that is gone on with needs what its checkpoint says.
  if (!options.resume) demand_disk_of(run);
  analysis.prepare();
  if (options.resume) refuse_without_checkpoints(options.directory);
  const io::DirectoryLock lock = take_directory(c, options);
  if (options.resume && analysis.resumable()) {
    run.from = analysis.resumable()->find(options.directory);
    if (run.from && is_complete(*run.from, options.directory)) return nothing_to_do(*run.from);
    run.plan = analysis.record_plan();
    demand_disk_of(run);
  }
  const std::string other = warning_of_another_host(options.directory);
  if (!other.empty()) give_warnings({other}, options);
  give_warnings(analysis.warnings(), options);
  Json json = describe(run);
  begin_files(analysis.kept_case(c), options, json);

  const Loop loop = record(run, json);
  RunReport report = report_of(run, loop);
  add_outcome(loop, json);
  analysis.summarise(json, report);
  json["total_wall_s"] = std::chrono::duration<double>(Clock::now() - begin).count();
  io::write_json(options.directory / "run.json", json);
  drop_checkpoint(options, loop.status);
  return report;
}

}  // namespace

RunReport run_case(const Case& c, const RunOptions& options) {
  static_cast<void>(dispatch_level());  // a wrong one is told before anything is built
  const auto begin = Clock::now();
  const std::unique_ptr<Analysis> analysis = make_analysis(c, options);
  return run_from(begin, *analysis, c, options);
}

RunReport run_analysis(Analysis& analysis, const Case& c, const RunOptions& options) {
  return run_from(Clock::now(), analysis, c, options);
}

}  // namespace rondo::study
