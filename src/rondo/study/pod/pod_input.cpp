// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/pod/pod_input.hpp"

#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "rondo/core/bytes.hpp"
#include "rondo/study/sweep/sweep.hpp"
#include "rondo/study/sweep/sweep_directory.hpp"

namespace rondo::study {
namespace {

template <class Value>
struct Word {
  const char* text;
  Value value;
};

/// The value of a word of the command line; for other words a fault that lists the allowed ones.
template <class Value, std::size_t N>
Value value_of(const char* option, const std::string& word,
               const std::array<Word<Value>, N>& words) {
  std::string allowed;
  for (const auto& [text, value] : words) {
    if (word == text) return value;
    allowed += fmt::format("{}{}", allowed.empty() ? "" : " | ", text);
  }
  throw request_error(option, word, "no such choice", allowed);
}

constexpr std::array quantities{Word<io::Quantity>{"displacement", io::Quantity::displacement},
                                Word<io::Quantity>{"velocity", io::Quantity::velocity},
                                Word<io::Quantity>{"contact", io::Quantity::contact}};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array weights{Word<Weight>{"mass", Weight::mass},
                             Word<Weight>{"delassus", Weight::delassus},
                             Word<Weight>{"none", Weight::none}};
constexpr std::array shifts{Word<pod::Shift>{"fourier", pod::Shift::fourier},
                            Word<pod::Shift>{"pitch", pod::Shift::pitch}};
constexpr std::array methods{Word<pod::Method>{"auto", pod::Method::automatic},
                             Word<pod::Method>{"direct", pod::Method::direct},
                             Word<pod::Method>{"tsqr", pod::Method::tsqr},
                             Word<pod::Method>{"incremental", pod::Method::incremental}};

template <class Value, std::size_t N>
const char* word_of(Value value, const std::array<Word<Value>, N>& words) {
  for (const auto& word : words)
    if (word.value == value) return word.text;
  return "";
}

void say_if_unfinished(const PodRequest& request, const io::RunReader& run) {
  if (!request.warn || run.status() == "done") return;
  // A run that ended normally has cut its datasets to the snapshots written.
  const std::string of = run.n_planned() > run.n_snapshots()
                             ? fmt::format(" of {} planned", run.n_planned())
                             : std::string();
  request.warn(
      fmt::format("{}: the run is not finished (status {}); its {} complete snapshots{} are used",
                  run.directory().string(), run.status(), run.n_snapshots(), of));
}

void refuse_twice(const PodRequest& request) {
  std::set<std::filesystem::path> seen;
  for (const std::filesystem::path& run : request.runs) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::canonical(run, error);
    if (!error && !seen.insert(whole).second)
      throw request_error("RUN", run.string(), "named twice", "each run once");
  }
}

/// Raises the limit of open files, because each run stays open while its snapshots are read.
void allow_open_files() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

io::RunReader open_run(const std::filesystem::path& directory) {
  try {
    return io::RunReader(directory);
  } catch (const FileError& error) {
    throw FileError(directory.string(),
                    fmt::format("{}; copy the run again or run the case again", error.what()));
  }
}

/// Whether all sectors have the same points; otherwise a field cannot be moved between them.
bool repeats(const mesh::Mesh& mesh, bool contact) {
  if (mesh.n_sectors == 0) return false;
  return (contact ? pod::boundary_rings(mesh) : pod::node_rings(mesh)).n_sectors > 0;
}

}  // namespace

SnapshotChoice snapshot_choice_of(const PodRequest& r) {
  SnapshotChoice choice;
  choice.quantity = value_of("--field", r.field, quantities);
  const bool contact = choice.quantity == io::Quantity::contact;
  choice.weight = r.weight.empty() ? (contact ? Weight::delassus : Weight::mass)
                                   : value_of("--weight", r.weight, weights);
  if (choice.weight == (contact ? Weight::mass : Weight::delassus))
    throw request_error("--weight", r.weight,
                        fmt::format("does not weigh a field of {}", contact ? "forces" : r.field),
                        contact ? "delassus | none" : "mass | none");
  const pod::Shift shift = value_of("--shift", r.shift, shifts);
  if (!is_co_rotating(r.frame, {})) choice.rectified = shift;
  if (r.modes && *r.modes < 1)
    throw request_error("--modes", fmt::to_string(*r.modes), "no modes to keep", "1 or more");
  if (r.reconstruct < 0)
    throw request_error("--reconstruct", fmt::to_string(r.reconstruct), "not a number of snapshots",
                        "0 or more");
  for (const auto& [option, time] : {std::pair{"--from", r.from}, {"--to", r.to}})
    if (time && std::isnan(*time))
      throw request_error(option, "nan", "not a time", "a number of seconds");
  return choice;
}

pod::Method method_of(const PodRequest& request) {
  return value_of("--method", request.method, methods);
}

std::size_t memory_of(const PodRequest& request) {
  const std::optional<std::size_t> bytes = bytes_in(request.memory);
  if (!bytes)
    throw request_error("--memory", request.memory, "not an amount of memory",
                        "e.g. 500MB, 2GB, 1.5GiB");
  return *bytes;
}

const char* name_of(pod::Method method) noexcept {
  return word_of(method, methods);
}

const char* name_of(Weight weight) noexcept {
  return word_of(weight, weights);
}

const char* unit_of(io::Quantity quantity, const io::RunReader& run) noexcept {
  switch (quantity) {
    case io::Quantity::displacement:
      return "m";
    case io::Quantity::velocity:
      return run.is_motion() ? "m/s" : "m";  // per fraction of the load
    case io::Quantity::contact:
      return run.mesh().is_solid() ? "N" : "N/m";
  }
  return "";
}

std::vector<io::RunReader> open_runs(const PodRequest& request, const SnapshotChoice& choice) {
  allow_open_files();
  std::vector<io::RunReader> runs;
  runs.reserve(request.runs.size());
  refuse_twice(request);
  for (const auto& directory : request.runs) {
    const io::RunReader& run = runs.emplace_back(open_run(directory));
    const std::string name = directory.string();
    if (run.n_snapshots() == 0)
      throw request_error(
          "RUN", name, fmt::format("the run holds no complete snapshot (status {})", run.status()),
          "a run with output.snapshots > 0 that got that far");
    if (!run.has(choice.quantity))
      throw request_error("--field", request.field,
                          fmt::format("{} holds no such field: the case has no [ground]", name),
                          "displacement | velocity");
    if (choice.rectified && !repeats(run.mesh(), choice.quantity == io::Quantity::contact))
      throw request_error(
          "--frame", request.frame,
          fmt::format("the mesh of {} has no equal sectors to move a field round", name),
          "--frame co-rotating");
    if (choice.rectified && choice.quantity == io::Quantity::velocity &&
        run.times().angle_velocity.empty())
      throw request_error("--frame", request.frame,
                          fmt::format("{} was written by an older version without the angles at "
                                      "the velocity's times",
                                      name),
                          "run the case again, or --frame co-rotating");
    if (choice.quantity == io::Quantity::velocity && run.is_motion() != runs.front().is_motion())
      throw request_error("RUN", name,
                          "the velocity of a crush is its rate over the load, not over time",
                          "velocities of runs of one kind together");
    const std::string difference = io::mesh_difference(runs.front(), run);
    if (!difference.empty())
      throw request_error(
          "RUN", name,
          fmt::format("not the mesh of {}: {}", request.runs.front().string(), difference),
          "runs of one mesh and density together");
    say_if_unfinished(request, run);
  }
  return runs;
}

bool is_in_window(const std::vector<io::RunReader>& runs, std::size_t run, double time,
                  const std::optional<double>& from, const std::optional<double>& to) {
  const auto is_in_time = [](const io::RunReader& r) {
    return r.is_motion() && r.analysis() != "steady-rolling";
  };
  if (!is_in_time(runs[run]) && std::ranges::any_of(runs, is_in_time)) return true;
  return time >= from.value_or(-infinity) && time <= to.value_or(infinity);
}

/// The snapshots of all runs in the window, in the order of the runs.
std::vector<SnapshotColumn> columns_of(const PodRequest& request, const SnapshotChoice& choice,
                                       const std::vector<io::RunReader>& runs) {
  const bool velocity = choice.quantity == io::Quantity::velocity;
  std::vector<SnapshotColumn> columns;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const io::RunTimes& of = runs[r].times();
    const std::vector<double>& times = velocity ? of.time_velocity : of.time;
    // Without rotation, files of earlier versions are sufficient, and their angles are not read.
    const std::vector<double>& angles =
        velocity && !of.angle_velocity.empty() ? of.angle_velocity : of.angle;
    const std::size_t before = columns.size();
    for (std::size_t j = 0; j < times.size(); ++j)
      if (is_in_window(runs, r, times[j], request.from, request.to))
        columns.push_back({.run = r, .snapshot = j, .time = times[j], .angle = angles[j]});
    if (columns.size() == before)
      throw request_error(
          "--from, --to",
          fmt::format("{:.9g} to {:.9g} s", request.from.value_or(-infinity),
                      request.to.value_or(infinity)),
          fmt::format("no snapshot of {} is in this window", runs[r].directory().string()),
          fmt::format("a window that meets [{:.9g}, {:.9g}] s, where its {} snapshots are",
                      times.front(), times.back(), times.size()));
  }
  return columns;
}

bool is_co_rotating(const std::string& frame, const std::function<void(const std::string&)>& warn) {
  if (frame == "rectified") return false;
  if (frame == "rotating" || frame == "turning") {
    if (warn) warn(fmt::format("--frame {} is now called --frame co-rotating", frame));
  } else if (frame != "co-rotating") {
    throw request_error("--frame", frame, "no such choice", "co-rotating | rectified");
  }
  return true;
}

PodRequest with_members(const PodRequest& asked) {
  PodRequest request = asked;
  request.runs.clear();
  for (const std::filesystem::path& directory : asked.runs) {
    std::error_code error;
    if (!std::filesystem::exists(directory / "sweep.json", error)) {
      if (std::filesystem::exists(directory / shards_folder, error))
        throw request_error("RUN", directory.string(), "holds shards that are not collected",
                            "rondo sweep STUDY --collect before");
      request.runs.push_back(directory);
      continue;
    }
    const std::vector<std::filesystem::path> runs = runs_of_sweep(directory);
    if (runs.empty() || io::RunReader(runs.front()).n_snapshots() == 0)
      throw request_error("RUN", directory.string(), "is a sweep without snapshots",
                          "a sweep whose study file says snapshots = true");
    request.runs.insert(request.runs.end(), runs.begin(), runs.end());
    if (asked.directory.empty() && asked.runs.size() == 1) request.directory = directory / "pod";
  }
  return request;
}

std::filesystem::path make_directory(const PodRequest& request) {
  if (request.directory.empty() && request.runs.size() > 1)
    throw request_error("-o", "", "several runs have one basis, which belongs to none of them",
                        "-o DIR");
  const auto base = request.directory.empty() ? request.runs.front() / "pod" : request.directory;
  const auto directory = base / fmt::format("{}-{}", request.field, request.frame);
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!error && access(directory.c_str(), W_OK | X_OK) != 0)
    error = std::error_code(errno, std::generic_category());
  if (error)
    throw FileError(
        directory.string(),
        fmt::format("cannot be made or written into: {}; choose another -o", error.message()));
  return directory;
}

}  // namespace rondo::study
