// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/run_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <thread>
#include <utility>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/region_figures.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/checkpoint.hpp"
#include "rondo/output/resume.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

/// The run has come to its end and its files are closed.
bool is_complete(const Checkpoint& k, const std::filesystem::path& directory) {
  try {
    return k.is_at_end && text_in(io::read_json(directory / "run.json"), "status") == "done";
  } catch (const FileError&) {
    return false;
  }
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

}  // namespace

RunSession::RunSession(Analysis& analysis, const Case& c, const RunOptions& options,
                       Recorder* memory, Clock::time_point begin)
    : analysis_(analysis),
      case_(c),
      options_(options),
      memory_(memory),
      begin_(begin),
      plan_(analysis.record_plan()) {
  // Before anything is removed; a run that is gone on with needs what its checkpoint says.
  if (has_files() && !options.resume) demand_disk_of();
  analysis.prepare();
  if (has_files()) take_directory();
  if (was_complete_) return;
  give_warnings(analysis.warnings(), options);
  json_ = describe();
  if (has_files()) begin_files(analysis.kept_case(c), options, json_);
  guarded([this] {
    open_recorder();
    looper_->begin();
  });
}

RunSession::~RunSession() = default;

/// And with it the run that is there to be gone on with.
void RunSession::take_directory() {
  if (options_.resume) refuse_without_checkpoints(options_.directory);
  lock_.emplace(study::take_directory(case_, options_));
  if (options_.resume && analysis_.resumable()) {
    find_checkpoint();
    was_complete_ = from_ && is_complete(*from_, options_.directory);
    if (was_complete_) json_ = io::read_json(options_.directory / "run.json");
    if (was_complete_) return;
    plan_ = analysis_.record_plan();
    demand_disk_of();
  }
  const std::string other = warning_of_another_host(options_.directory);
  if (!other.empty()) give_warnings({other}, options_);
}

/// Before anything is changed: all bits are there of what the run goes on with.
void RunSession::find_checkpoint() {
  try {
    from_ = analysis_.resumable()->find(options_.directory);
    if (from_) demand_kept(options_.directory, from_->files);
  } catch (const FileError& error) {
    throw FileError(error, fmt::format("restore that file, or run the case anew: rondo run CASE "
                                       "-o {} --overwrite, with a case file outside of it",
                                       options_.directory.string()));
  }
}

void RunSession::demand_disk_of() const {
  demand_disk(options_, disk_needed(plan_, analysis_.resumable() != nullptr));
}

void RunSession::open_recorder() {
  if (has_files()) files_ = std::make_unique<FileRecorder>(options_.directory, plan_, from_);
  Recorder* const recorder = has_files() ? files_.get() : memory_;
  looper_.emplace(LoopPlan{analysis_, options_, case_.output.checkpoint_interval, from_,
                           [this] { keep_case(); }},
                  *recorder);
}

/// What a checkpoint goes on with is the case as it was then.
void RunSession::keep_case() {
  if (!case_changed_ || !has_files()) return;
  write_case_file(analysis_.kept_case(case_), options_);
  case_changed_ = false;
}

/// A file that cannot be written ends the run: run.json says so, where it can still be written
/// itself.
void RunSession::guarded(const std::function<void()>& work) {
  try {
    work();
  } catch (const FileError& error) {
    broken_ = true;
    const FileError whole(error, what_is_kept());
    if (has_files()) note_failure(options_, json_, whole);
    broken_by_ = whole;
    throw whole;
  } catch (const std::bad_alloc& error) {
    broken_ = true;
    if (has_files()) note_failure(options_, json_, error);
    throw;
  }
}

/// What is left after an error of files, and what can be done.
std::string RunSession::what_is_kept() {
  const std::string kept = files_ ? files_->kept() : "what was there is kept";
  if (!analysis_.resumable()) return kept;
  const long long before = from_ ? from_->state.step : 0;
  const long long step = files_ ? files_->saved_step() : before;
  return step > 0 ? fmt::format("{}; --resume resumes from step {}", kept, step)
                  : kept + "; there is no checkpoint yet to resume from";
}

void RunSession::advance() {
  guarded([this] { looper_->advance(); });
}

void RunSession::save() {
  guarded([this] {
    looper_->save();
    while (files_ && files_->is_saving()) {
      files_->keep_up();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
}

void RunSession::interrupt() noexcept {
  if (looper_ && !broken_) looper_->interrupt();
}

RunReport RunSession::finish() {
  if (was_complete_) return nothing_to_do();
  Loop loop;
  if (broken_) {
    files_.reset();
    lock_.reset();
    loop.status = RunStatus::failed;
    return report_of(loop);
  }
  guarded([&] {
    loop = looper_->finish();
    if (!files_) return;
    files_->close();
    json_["files"] = as_json(files_->files());
    loop.snapshots = files_->written();
    loop.last_time = files_->last_time();
    loop.output = files_->cost();
  });
  RunReport report = report_of(loop);
  add_outcome(loop, json_);
  analysis_.summarise(json_, report);
  json_["total_wall_s"] = std::chrono::duration<double>(Clock::now() - begin_).count();
  if (has_files()) {
    keep_case();
    io::write_json(options_.directory / "run.json", json_);
    drop_checkpoint(loop.status);
  }
  lock_.reset();
  return report;
}

// run.json ----------------------------------------------------------------------------------------

Json RunSession::describe() const {
  Json json = describe_run(case_, plan_.results.words.analysis);
  json["resumable"] = analysis_.resumable() != nullptr;
  analysis_.describe(json);
  if (plan_.results.mesh != nullptr) describe_regions(*plan_.results.mesh, plan_.materials, json);
  json["columns"] = Json::array();
  for (const ColumnLabel& column : plan_.columns)
    json["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  add_warnings(json);
  add_resumed(json);
  return json;
}

/// An array of the run.json of a run that is resumed; empty where there is none.
Json RunSession::array_before(const char* key) const {
  if (!from_) return Json::array();
  try {
    const Json before = io::read_json(options_.directory / "run.json");
    const auto found = before.find(key);
    if (found != before.end() && found->is_array()) return *found;
  } catch (const FileError&) {  // a lost run.json loses nothing else
  }
  return Json::array();
}

/// Those before a checkpoint stay; what is said again at the start stands there once.
void RunSession::add_warnings(Json& json) const {
  Json all = array_before("warnings");
  for (const std::string& warning : analysis_.warnings())
    if (std::find(all.begin(), all.end(), Json(warning)) == all.end()) all.push_back(warning);
  json["warnings"] = std::move(all);
}

void RunSession::add_resumed(Json& json) const {
  if (!from_) return;
  Json steps = array_before("resumed_at_steps");
  steps.push_back(from_->state.step);
  json["resumed_at_steps"] = std::move(steps);
}

RunReport RunSession::report_of(const Loop& loop) const {
  RunReport r;
  r.status = loop.status;
  r.message = loop.message;
  r.resumable = analysis_.resumable() != nullptr;
  r.resumed_at = from_ ? from_->state.step : 0;
  r.loop_wall_s = loop.wall_s;
  r.snapshots = loop.snapshots;
  return r;
}

RunReport RunSession::nothing_to_do() const {
  RunReport r;
  r.status = RunStatus::done;
  r.was_complete = true;
  r.steps = from_->state.step;
  r.end_time = static_cast<double>(r.steps) * from_->identity.step;
  r.reached = fmt::format("{} steps to t = {:.6g} s", r.steps, r.end_time);
  r.snapshots = from_->files.snapshots.count;
  return r;
}

/// One of the time before the end, of a run that keeps none.
void RunSession::drop_checkpoint(RunStatus status) const {
  std::error_code error;  // it does no harm
  if (!options_.keeps_checkpoint && status == RunStatus::done)
    std::filesystem::remove(options_.directory / checkpoint_name, error);
}

}  // namespace rondo::study
