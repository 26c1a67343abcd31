// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "rondo/analysis/reduced_run.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/run_reader.hpp"
#include "rondo/study/paper/validation_compare.hpp"
#include "rondo/study/paper/validation_table.hpp"
#include "rondo/study/pod/pod_input.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* option = "--validate";

bool is_reduced(const fs::path& directory) {
  std::error_code error;
  const fs::path file = directory / "run.json";
  return fs::exists(file, error) && io::read_json(file).contains("reduced_modes");
}

std::vector<fs::path> members(const std::vector<fs::path>& directories) {
  PodRequest pod;
  pod.runs = directories;
  return with_members(pod).runs;
}

void check_run(const fs::path& directory) {
  const io::RunReader run(directory);
  const std::string name = directory.string();
  if (run.analysis() != "dynamic")
    throw request_error(option, name, "a crush does not roll: there is no motion to predict",
                        "runs of analysis.kind = \"dynamic\"");
  if (is_reduced(directory))
    throw request_error(option, name, "is a reduced run itself",
                        "runs of the full model: the same case without --reduced");
  if (run.status() != "done")
    throw request_error(option, name,
                        fmt::format("the run is not finished (status {})", run.status()),
                        "finish it (rondo run RUN --resume), or leave it out");
  if (run.n_snapshots() < 2 || !run.has(io::Quantity::displacement) ||
      !run.has(io::Quantity::velocity) || run.times().angle_velocity.empty())
    throw request_error(option, name,
                        fmt::format("{} snapshots of displacement and velocity are nothing to "
                                    "compare with",
                                    run.n_snapshots()),
                        "a run of this version with output.snapshots of 2 or more");
}

void check_body(const fs::path& directory, const std::string& body, const fs::path& of) {
  const std::string difference =
      body_difference(body_text(read_case(directory / "case.toml")), body);
  if (!difference.empty())
    throw request_error(
        option, directory.string(),
        fmt::format("is of another mesh or material than {}: it has {}", of.string(), difference),
        "runs of the mesh and material of the model");
}

void check_options(const ValidationRequest& r) {
  if (!(r.step_factor > 0.0 && std::isfinite(r.step_factor)))
    throw request_error("--step-factor", fmt::format("{:.9g}", r.step_factor),
                        "not a factor for the step of the full run", "a number above 0, e.g. 20");
  demand_step_name(r.reduced_step);
  std::set<fs::path> seen;
  for (const fs::path& run : members(r.held_out))
    if (!seen.insert(fs::weakly_canonical(run)).second)
      throw request_error(option, run.string(), "named twice", "each run once");
}

/// The model knows the runs behind it as they were named: from the same directory they are found.
void warn_of_known(const ReducedFile& model, const fs::path& run, const ValidationRequest& r) {
  std::error_code error;
  for (const std::string& known : model.runs)
    if (fs::equivalent(known, run, error) && r.warn)
      r.warn(
          fmt::format("{} is one of the runs that the model was built from: what it shows is "
                      "how well the model remembers, not how well it predicts",
                      run.string()));
}

/// Names of the runs' directories, made unique.
std::vector<std::string> names_of(const std::vector<fs::path>& runs) {
  std::vector<std::string> names;
  for (const fs::path& run : runs) {
    const std::string name = fs::weakly_canonical(run).filename().string();
    std::string unique = name;
    for (int k = 2; std::ranges::find(names, unique) != names.end(); ++k)
      unique = fmt::format("{}-{}", name, k);
    names.push_back(unique);
  }
  return names;
}

/// Only predictions are replaced.
void demand_ours(const fs::path& directory) {
  if (io::mark_of_run(directory).empty() || is_reduced(directory)) return;
  io::refuse_directory(directory, "holds something else than a reduced run",
                       "another -o, or that directory moved away");
}

void predict(const ValidationRequest& request, Validated& run) {
  if (request.begins) request.begins(run.name);
  RunOptions options;
  options.directory = run.reduced;
  options.overwrite = true;
  options.reduced = request.model;
  options.step_factor = request.step_factor;
  options.reduced_step = request.reduced_step;
  options.warn = request.warn;
  options.progress = request.progress;
  options.before_loop = request.before_loop;
  options.stop = request.stop;
  const RunReport report = run_case(read_case(run.full / "case.toml"), options);
  run.status = report.status;
  run.message = report.message;
}

/// What an earlier validation left and this one does not write again.
void clear(const fs::path& directory) {
  std::error_code error;
  for (const char* name : {validation_table_name, validation_record_name})
    fs::remove(directory / name, error);
}

std::vector<Validated> plan(const ValidationRequest& request, const ReducedFile& model) {
  const std::vector<fs::path> runs = members(request.held_out);
  const std::vector<std::string> names = names_of(runs);
  std::vector<Validated> planned;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    check_body(runs[k], model.body, request.model);
    warn_of_known(model, runs[k], request);
    const fs::path directory = validation_directory(request.model) / names[k];
    demand_ours(directory);
    Validated& run = planned.emplace_back();
    run.name = names[k];
    run.full = runs[k];
    run.reduced = directory;
  }
  return planned;
}

}  // namespace

RunStatus ValidationReport::status() const noexcept {
  RunStatus worst = RunStatus::done;
  for (const Validated& run : runs) {
    if (run.status == RunStatus::interrupted) return RunStatus::interrupted;
    if (run.status == RunStatus::failed) worst = RunStatus::failed;
  }
  return worst;
}

fs::path validation_directory(const fs::path& model) {
  return model.parent_path() / (model.stem().string() + "-validation");
}

void check_held_out(const ValidationRequest& request) {
  check_options(request);
  const std::vector<fs::path> built_from = members(request.built_from);
  for (const fs::path& run : members(request.held_out)) {
    check_run(run);
    static_cast<void>(window_of(request, run));
    if (!built_from.empty())
      check_body(run, body_text(read_case(built_from.front() / "case.toml")), built_from.front());
  }
}

ValidationReport validate(const ValidationRequest& request) {
  check_held_out(request);
  const ReducedFile model = read_reduced_file(request.model);
  ValidationReport report;
  report.directory = validation_directory(request.model);
  report.runs = plan(request, model);
  clear(report.directory);
  for (Validated& run : report.runs) {
    predict(request, run);
    if (run.status == RunStatus::interrupted) return report;
    if (run.status == RunStatus::done) compare(model, window_of(request, run.full), run);
  }
  write_validation(request, report);
  return report;
}

}  // namespace rondo::study
