// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <system_error>

#include "rondo/core/error.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/paper/paper_checks.hpp"
#include "rondo/study/paper/paper_jobs.hpp"
#include "rondo/study/paper/paper_plan.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* format_name = "rondo paper 1";

/// What paper.json of the directory says of its study; with `overwrite` it may say anything.
void accept(const PaperRequest& request, const fs::path& paper) {
  if (request.overwrite) return;
  Json found;
  try {
    found = io::read_json(paper);
  } catch (const FileError&) {
    throw FileError(paper.string(), "cannot be read as JSON: --overwrite makes the study anew");
  }
  const std::string format = text_in(found, "format");
  if (format != format_name)
    io::refuse_directory(
        request.directory,
        fmt::format("holds a study of format \"{}\", not \"{}\"", format, format_name),
        "choose another -o");
  const bool quick = found.contains("quick") && found["quick"] == true;
  if (quick != request.quick)
    io::refuse_directory(request.directory,
                         quick ? "holds the quick study" : "holds the study in full",
                         "choose another -o, or give --overwrite");
}

/// The name of something in runs/ that is not of this study; empty if there is none.
std::string foreign_in(const fs::path& runs, const PaperPlan& plan) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(runs, error)) {
    const std::string name = entry.path().filename().string();
    if (std::none_of(plan.runs.begin(), plan.runs.end(),
                     [&](const PaperRun& run) { return run.name == name; }))
      return name;
  }
  return {};
}

/// A directory that holds no study, or one of the same kind, which goes on. Nothing is made before
/// it is known to be right.
void prepare(const PaperRequest& request, const PaperPlan& plan) {
  const fs::path& directory = request.directory;
  const std::string elsewhere = "choose another -o";
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    io::refuse_directory(directory, "is there and is not a directory", elsewhere);
  if (fs::exists(directory / "paper.json", error)) {
    accept(request, directory / "paper.json");
  } else if (fs::exists(directory / "run.json", error)) {
    io::refuse_directory(directory, "holds a run, not a study", elsewhere);
  } else if (const std::string name = foreign_in(directory / "runs", plan); !name.empty()) {
    io::refuse_directory(directory, fmt::format("holds runs/{}, which is not of this study", name),
                         elsewhere);
  }
  fs::create_directories(directory / "runs", error);
  if (error)
    throw FileError((directory / "runs").string(),
                    "cannot create directory: " + error.message() + "; choose another -o");
}

/// A run that may fail is done as a job, and has failed as a run.
const char* status_of(const JobOutcome& outcome) {
  switch (outcome.status) {
    case JobStatus::waiting:
    case JobStatus::running:  // told once it has ended
      return "waiting";
    case JobStatus::done:
      return outcome.code == job_done ? "done" : "failed";
    case JobStatus::failed:
      return "failed";
    case JobStatus::interrupted:
      return "interrupted";
  }
  return "";
}

/// The study as it goes on, and what is written of it.
class Record {
 public:
  Record(const PaperRequest& request, const PaperPlan& plan, std::span<const PaperJob> jobs)
      : request_(request), plan_(plan), jobs_(jobs), outcomes_(jobs.size()) {
    for (std::size_t k = 0; k < jobs.size(); ++k)
      if (jobs[k].there) outcomes_[k] = jobs[k].found;
  }

  void set(std::size_t job, const JobOutcome& outcome) { outcomes_[job] = outcome; }
  [[nodiscard]] const std::vector<JobOutcome>& outcomes() const noexcept { return outcomes_; }

  void write(const char* status, const PaperReport& report) const {
    io::write_json(path(), as_json(status, report));
  }
  /// After an error, of which the disk may be full.
  void write_failure(const PaperReport& report) const noexcept {
    try {
      write("failed", report);
    } catch (const std::exception&) {
      io::overwrite_json(path(), as_json("failed", report));
    }
  }

 private:
  [[nodiscard]] fs::path path() const { return request_.directory / "paper.json"; }

  [[nodiscard]] Json as_json(const char* status, const PaperReport& report) const {
    Json j;
    j["format"] = format_name;
    j["status"] = status;
    if (!report.message.empty()) j["message"] = report.message;
    j["quick"] = request_.quick;
    describe_program(j);
    j["wall_s"] = report.wall_s;
    j["runs"] = Json::array();
    j["pods"] = Json::array();
    for (std::size_t k = 0; k < jobs_.size(); ++k)
      j[jobs_[k].is_pod ? "pods" : "runs"].push_back(describe(k));
    j["table"] = Json::array();
    for (const PaperRow& row : report.rows) j["table"].push_back(study::as_json(row));
    const auto passed = std::count_if(report.rows.begin(), report.rows.end(), passes);
    j["passed"] = passed;
    j["failed"] = static_cast<std::ptrdiff_t>(report.rows.size()) - passed;
    return j;
  }

  [[nodiscard]] Json describe(std::size_t k) const {
    const PaperJob& job = jobs_[k];
    Json j;
    if (job.is_pod) {
      const PaperPod& pod = plan_.pods[job.of];
      j = {{"run", pod.run}, {"field", pod.field}, {"frame", pod.frame}};
    } else {
      j["name"] = plan_.runs[job.of].name;
    }
    j["directory"] = job.directory.generic_string();
    j["command"] = job.command;
    j["status"] = status_of(outcomes_[k]);
    if (!outcomes_[k].message.empty()) j["message"] = outcomes_[k].message;
    j["kept"] = job.there;
    j["wall_s"] = outcomes_[k].wall_s;
    return j;
  }

  const PaperRequest& request_;
  const PaperPlan& plan_;
  std::span<const PaperJob> jobs_;
  std::vector<JobOutcome> outcomes_;
};

/// The jobs that are not there, and the places of all of them in that list.
struct ToDo {
  std::vector<Job> jobs;
  std::vector<std::size_t> from;  ///< place in all jobs of each
};

ToDo to_do(std::span<const PaperJob> all) {
  ToDo list;
  std::vector<std::size_t> place(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].there) continue;
    Job job = all[k].job;
    std::erase_if(job.after, [&](std::size_t before) { return all[before].there; });
    for (std::size_t& before : job.after) before = place[before];
    place[k] = list.jobs.size();
    list.jobs.push_back(std::move(job));
    list.from.push_back(k);
  }
  return list;
}

void do_jobs(const PaperRequest& request, std::span<const PaperJob> jobs, Record& record,
             PaperReport& report) {
  const ToDo list = to_do(jobs);
  report.jobs = jobs.size();
  report.kept = jobs.size() - list.jobs.size();
  if (request.begin) request.begin(list.jobs, report.kept);
  JobsOptions options;
  options.at_once = request.at_once;
  options.stop = request.stop;
  options.progress = request.progress;
  options.ended = [&](std::size_t k, const JobOutcome& outcome) {
    record.set(list.from[k], outcome);
    record.write("running", report);
    if (request.ended) request.ended(k, outcome);
  };
  static_cast<void>(run_jobs(list.jobs, options));  // each outcome came by `ended`
}

/// How the jobs ended, but for the table.
void judge_jobs(std::span<const PaperJob> jobs, const Record& record, PaperReport& report) {
  report.status = RunStatus::done;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const JobOutcome& outcome = record.outcomes()[k];
    if (outcome.status == JobStatus::done) {
      report.done += jobs[k].there ? 0 : 1;
    } else if (outcome.status == JobStatus::failed && report.status != RunStatus::failed) {
      report.status = RunStatus::failed;
      report.code = outcome.code;
      report.message = jobs[k].job.name + ": " + outcome.message;
    } else if (report.status == RunStatus::done) {
      report.status = RunStatus::interrupted;
      report.code = job_interrupted;
    }
  }
}

void judge_rows(PaperReport& report) {
  const auto wrong = std::count_if(report.rows.begin(), report.rows.end(),
                                   [](const PaperRow& row) { return !passes(row); });
  if (wrong == 0) return;
  report.status = RunStatus::failed;
  report.code = job_failed;
  report.message =
      fmt::format("{} of {} rows of the table are not as expected", wrong, report.rows.size());
}

}  // namespace

PaperReport run_paper(const PaperRequest& request) {
  const auto begin = Clock::now();
  const PaperPlan plan = paper_plan(request.quick);
  prepare(request, plan);
  const io::DirectoryLock lock(request.directory);
  const std::vector<PaperJob> jobs = paper_jobs(request.directory, plan, request.overwrite);
  PaperReport report;
  Record record(request, plan, jobs);
  record.write("running", report);
  try {
    do_jobs(request, jobs, record, report);
    judge_jobs(jobs, record, report);
    if (report.status == RunStatus::done) {
      report.rows = check_paper(request.directory, plan, request.quick);
      judge_rows(report);
    }
  } catch (const std::exception& error) {
    report.message = error.what();
    record.write_failure(report);
    throw;
  }
  report.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  static constexpr std::array<const char*, 3> names{"done", "interrupted", "failed"};
  record.write(names[static_cast<std::size_t>(report.status)], report);
  return report;
}

}  // namespace rondo::study
