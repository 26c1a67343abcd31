// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/paper_jobs.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "rondo/analysis/run.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/paper/paper_results.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/sweep/kept_runs.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

std::string wanted(const std::string& message) {
  return "failed, as it should: " + message;
}

/// How a run that is there ended: one that may fail says why.
JobOutcome outcome_of(const fs::path& directory) {
  const Json j = io::read_json(directory / "run.json");
  const bool failed = text_in(j, "status") == "failed";
  return {JobStatus::done, failed ? job_failed : job_done,
          failed ? wanted(text_in(j, "message")) : "", 0.0};
}

/// What a POD of the study has by default, and of all snapshots of its run.
bool is_asked_for(const Json& j, const PaperPod& pod, const Json& run) {
  const double modes = number_in(j, "modes_kept"), snapshots = number_in(j, "snapshots");
  return text_in(j, "status") == "done" && text_in(j, "field") == pod.field &&
         text_in(j, "frame") == pod.frame &&
         text_in(j, "weight") == (pod.field == "contact" ? "delassus" : "mass") &&
         text_in(j, "shift") == (pod.frame == "rectified" ? "fourier" : "") && snapshots >= 0.0 &&
         snapshots == number_in(run, "snapshots") &&
         (modes == paper_modes || (modes >= 0.0 && modes == number_in(j, "rank")));
}

bool pod_is_there(const fs::path& run, const PaperPod& pod) {
  const fs::path directory = run / "pod" / (pod.field + "-" + pod.frame);
  try {
    const Json j = io::read_json(directory / "pod.json");
    static_cast<void>(io::h5::File::open(directory / "pod.h5"));  // it opens
    const fs::path spectrum = directory / "spectrum.csv";
    const Columns columns = io::read_columns(spectrum);
    return is_of_this_program(j) && is_asked_for(j, pod, io::read_json(run / "run.json")) &&
           !column(columns, "singular_value", spectrum).empty();
  } catch (const std::exception&) {
    return false;
  }
}

JobReport report_of(const RunReport& r, bool may_fail) {
  switch (r.status) {
    case RunStatus::done:
      return {};
    case RunStatus::interrupted:
      return {job_interrupted, {}, {}};
    case RunStatus::failed:
      break;
  }
  return {job_failed, may_fail ? wanted(r.message) : r.message, may_fail};
}

JobReport do_run(const fs::path& directory, const Case& c, bool may_fail, JobChannel& channel) {
  remove_unfinished(directory);
  RunOptions options;
  options.directory = directory;
  options.threads = 1;
  options.overwrite = true;
  options.stop = channel.stop();
  options.progress = [&](long long done, long long total) { channel.progress(done, total); };
  return report_of(run_case(c, options), may_fail);
}

/// It takes about a second, and is finished in spite of a signal.
JobReport do_pod(const fs::path& run, const PaperPod& pod, JobChannel& channel) {
  remove_unfinished(run / "pod" / (pod.field + "-" + pod.frame));
  PodRequest request;
  request.runs = {run};
  request.field = pod.field;
  request.frame = pod.frame;
  request.modes = paper_modes;
  request.reconstruct = 0;
  request.progress = [&](long long done, long long total) { channel.progress(done, total); };
  const PodReport report = run_pod(request);
  if (!report.trouble.empty()) return {job_failed, report.trouble, {}};
  return {};
}

/// Nodes of the mesh and, up to a factor, steps of the run: the critical step goes with the layers.
/// Only the order of the jobs and the bar of progress hang on it.
double cost_of(const Case& c) {
  const double layers = c.disk.radial + (c.disk.tread ? c.disk.tread->layers : 0);
  const auto nodes = static_cast<double>(mesh::n_disk_nodes(c.disk));
  if (c.analysis.kind == AnalysisKind::crush) return 0.01 * nodes * layers;
  const double speed = std::sqrt(c.material.youngs_modulus / 2.0e7);
  return nodes * layers * (c.time.end / 0.12) * speed + nodes * c.output.snapshots / 100.0;
}

}  // namespace

std::vector<PaperJob> paper_jobs(const fs::path& directory, const PaperPlan& plan, bool again) {
  std::vector<PaperJob> jobs;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const PaperRun& run = plan.runs[k];
    const Case c = case_of(run);
    PaperJob job;
    job.directory = fs::path("runs") / run.name;
    job.command = command_of(run, directory);
    job.of = k;
    const fs::path results = directory / job.directory;
    job.there = !again && run_is_there(results, c, run.may_fail);
    if (job.there) job.found = outcome_of(results);
    job.job = {run.name, cost_of(c), {}, [=, may_fail = run.may_fail](JobChannel& channel) {
                 return do_run(results, c, may_fail, channel);
               }};
    jobs.push_back(std::move(job));
  }
  for (std::size_t k = 0; k < plan.pods.size(); ++k) {
    const PaperPod& pod = plan.pods[k];
    const auto run = static_cast<std::size_t>(
        std::find_if(plan.runs.begin(), plan.runs.end(),
                     [&](const PaperRun& r) { return r.name == pod.run; }) -
        plan.runs.begin());
    PaperJob job;
    job.directory = fs::path("runs") / pod.run / "pod" / (pod.field + "-" + pod.frame);
    job.command = command_of(pod, directory);
    job.is_pod = true;
    job.of = k;
    // A run made again takes its PODs with it.
    job.there = jobs[run].there && pod_is_there(directory / "runs" / pod.run, pod);
    if (job.there) job.found.status = JobStatus::done;
    const fs::path results = directory / "runs" / pod.run;
    job.job = {pod.run + " " + pod.field + "-" + pod.frame,
               0.2 * jobs[run].job.weight,
               {run},
               [=](JobChannel& channel) { return do_pod(results, pod, channel); }};
    jobs.push_back(std::move(job));
  }
  return jobs;
}

}  // namespace rondo::study
