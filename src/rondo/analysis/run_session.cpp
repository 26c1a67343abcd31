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

constexpr JsonMember<bool> resumable_members[] = {
    {"resumable", "boolean", "", "The run writes checkpoints",
     [](const bool& resumable) -> Json { return resumable; }},
};

constexpr JsonMember<ColumnLabel> column_members[] = {
    {"name", "string", "", "Name of the column",
     [](const ColumnLabel& column) -> Json { return column.name; }},
    {"unit", "string", "", "Its unit; \"1\": none",
     [](const ColumnLabel& column) -> Json { return column.unit; }},
};

struct Begun {
  const std::vector<ColumnLabel>& columns;
  Json warnings, resumed_at;  ///< absent(): the run was not resumed
};
constexpr JsonMember<Begun> begun_run_members[] = {
    {"columns", "array", "", "Columns of `history.csv`, in order",
     [](const Begun& b) { return objects_of(column_members, b.columns); },
     [] { return texts_of(column_members); }},
    {"warnings", "array of string", "",
     "All warnings, those during the steps with the time. A resumed run includes those of the "
     "calls before; if such a call was killed, only those of its start",
     [](const Begun& b) { return b.warnings; }},
    {"resumed_at_steps", "array of integer", "", "Only for a resumed run: steps of the checkpoints",
     [](const Begun& b) { return b.resumed_at; }},
};

constexpr JsonMember<KeptFiles> file_members[] = {
    {"files", "object", "",
     "For `--resume`, contents of the files at the end: for each table `bytes` and the hash "
     "`xxh3-128`; for `results.h5` the number of `snapshots`, and the hash of each dataset that "
     "has a row per snapshot",
     [](const KeptFiles& files) { return as_json(files); }},
};

constexpr JsonMember<OutputCost> output_members[] = {
    {"wait_wall_s", "number", "s",
     "Wall time of the loop for copying data and waiting for a free buffer",
     [](const OutputCost& o) -> Json { return o.wait_wall_s; }},
    {"drain_wall_s", "number", "s", "Wall time after the loop, until everything was written",
     [](const OutputCost& o) -> Json { return o.drain_wall_s; }},
    {"write_wall_s", "number", "s",
     "Wall time of the writer thread, which recovers stresses, formats and writes",
     [](const OutputCost& o) -> Json { return o.write_wall_s; }},
    {"queue_full", "integer", "", "How often the loop found no free buffer",
     [](const OutputCost& o) -> Json { return o.queue_full; }},
};

constexpr JsonMember<Loop> loop_members[] = {
    {"loop_wall_s", "number", "s",
     "Wall time of the steps or increments, including waits for output; in a resumed run with the "
     "time up to the checkpoint",
     [](const Loop& loop) -> Json { return loop.wall_s; }},
    {"loop_cpu_s", "number", "s",
     "Processor time of all threads during the loop, the writer thread included",
     [](const Loop& loop) -> Json { return loop.cpu_s; }},
    {"peak_memory_bytes", "integer", "B", "Largest memory of the process",
     [](const Loop&) -> Json { return peak_memory_bytes(); }},
    {"snapshots", "integer", "", "Snapshots written",
     [](const Loop& loop) -> Json { return loop.snapshots; }},
    {"last_time", "number", "s", "`time_s` of the last row of `history.csv`",
     [](const Loop& loop) -> Json { return loop.last_time; }},
    {"output", "object", "", "Cost of output",
     [](const Loop& loop) { return object_of(output_members, loop.output); },
     [] { return texts_of(output_members); }},
};

constexpr JsonMember<double> total_members[] = {
    {"total_wall_s", "number", "s", "Wall time from reading the case to the last result written",
     [](const double& seconds) -> Json { return seconds; }},
};

}  // namespace

std::vector<MemberText> session_members() {
  return joined({texts_of(resumable_members), texts_of(begun_run_members), texts_of(file_members),
                 texts_of(loop_members), texts_of(total_members)});
}

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

/// Writes the case again: a checkpoint goes on with the case as it was then.
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

/// Tells what is left after an error of files, and what can be done.
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
    add_members(file_members, files_->files(), json_);
    loop.snapshots = files_->written();
    loop.last_time = files_->last_time();
    loop.output = files_->cost();
  });
  RunReport report = report_of(loop);
  add_status(json_, loop.status, loop.message);
  add_members(loop_members, loop, json_);
  analysis_.summarise(json_, report);
  add_members(total_members, std::chrono::duration<double>(Clock::now() - begin_).count(), json_);
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
  add_members(resumable_members, analysis_.resumable() != nullptr, json);
  analysis_.describe(json);
  if (plan_.results.mesh != nullptr) describe_regions(*plan_.results.mesh, plan_.materials, json);
  add_members(begun_run_members, {plan_.columns, warnings_with_earlier(), resumed_at()}, json);
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
Json RunSession::warnings_with_earlier() const {
  Json all = array_before("warnings");
  for (const std::string& warning : analysis_.warnings())
    if (std::find(all.begin(), all.end(), Json(warning)) == all.end()) all.push_back(warning);
  return all;
}

Json RunSession::resumed_at() const {
  if (!from_) return absent();
  Json steps = array_before("resumed_at_steps");
  steps.push_back(from_->state.step);
  return steps;
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
