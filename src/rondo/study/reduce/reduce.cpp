// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/reduce/reduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/reduced/prepare_wheel.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/rom/wheel/pod_modes.hpp"
#include "rondo/study/pod/pod_input.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long long most_modes = 100000;

bool is_results(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

WheelBasis basis_of(const ReduceRequest& r) {
  for (const WheelBasis basis : {WheelBasis::eigenmodes, WheelBasis::pod})
    if (r.basis == name_of(basis)) return basis;
  if (!r.basis.empty())
    throw request_error("--basis", r.basis, "no such choice", "eigenmodes | pod");
  return is_results(r.sources.front()) ? WheelBasis::pod : WheelBasis::eigenmodes;
}

void check(const ReduceRequest& r, WheelBasis basis) {
  if (r.output.empty()) throw request_error("-o", "", "the wheel needs a file", "-o wheel.h5");
  std::error_code error;
  if (std::filesystem::exists(r.output, error) && !is_wheel_file(r.output))
    throw request_error("-o", r.output.string(), "is there, and no file of rondo reduce",
                        "another name, e.g. -o wheel.h5");
  if (r.modes && *r.modes > most_modes)
    throw request_error("--modes", fmt::to_string(*r.modes), "is no number of modes",
                        fmt::format("a whole number up to {}", most_modes));
  if (basis == WheelBasis::pod) {
    for (const std::filesystem::path& source : r.sources)
      if (std::filesystem::is_regular_file(source, error))
        throw request_error("--basis", name_of(basis),
                            fmt::format("is of results, and {} is a file", source.string()),
                            "results directories; or a case without --basis, for its eigenmodes");
    if (!r.settings.empty())
      throw request_error("--set", r.settings.front(), "is of a case, and a POD is of runs",
                          "runs of other cases: rondo run CASE.toml --set KEY=VALUE");
    if (r.modes && *r.modes < 1)
      throw request_error("--modes", fmt::to_string(*r.modes), "no modes to keep", "1 or more");
    return;
  }
  if (r.sources.size() > 1 || is_results(r.sources.front()))
    throw request_error("--basis", name_of(basis), "is of one case",
                        "rondo reduce CASE.toml -o wheel.h5; or --basis pod with results "
                        "directories");
  if (r.from || r.to)
    throw request_error(r.from ? "--from" : "--to", fmt::format("{:.9g}", r.from ? *r.from : *r.to),
                        "is of the snapshots of runs, and eigenmodes need none",
                        "--basis pod with results directories");
}

/// The runs of a POD of displacements.
PodRequest pod_request(const ReduceRequest& r) {
  PodRequest pod;
  pod.runs = r.sources;
  pod.field = "displacement";
  pod.from = r.from;
  pod.to = r.to;
  pod.warn = r.warn;
  return with_members(pod);
}

/// The case of a run as one that moves in time, with its wheel at rest off the ground: all that is
/// asked of it does not depend on the motion but for the spin, and nothing on how contact is
/// solved.
Case case_of(const io::RunReader& run, bool& free_spin) {
  Case c = read_case(run.directory() / "case.toml");
  if (is_solid(c))
    throw request_error("RUN", run.directory().string(),
                        "the body is a wheel in three dimensions, and reduced wheels are plane",
                        "runs of a [disk] without disk.width; rondo pod decomposes this one");
  if (!c.ground)
    throw request_error("RUN", run.directory().string(),
                        "has no ground, on which a reduced wheel rolls", "runs with [ground]");
  if (!is_held(c))
    throw request_error("RUN", run.directory().string(),
                        "the body is free, and a reduced wheel is held by its rim",
                        "runs of a body with a rim");
  if (c.rim && c.rim->free_spin) free_spin = true;
  c.analysis = {};
  c.initial = {};
  c.contact_mass = ContactMass::lumped;
  c.implicit.clear();
  c.rim.reset();
  c.pressures.clear();
  c.time.scheme = Scheme::symplectic;
  c.time.step.reset();
  c.ground->restitution = 0.0;
  c.ground->impact = contact::Impact::moreau;
  double top = 0.0;
  for (const Vec2 corner : c.ground->shape.profile) top = std::max(top, corner.y);
  c.motion.height = dynamics::Table(top + 2.0 * std::max(1.0, c.disk.outer_radius));
  c.motion.speed = dynamics::Table(0.0);
  if (!(c.time.end > 0.0)) c.time.end = 1.0;
  return c;
}

/// The case of all runs together. They have one body; their spins may differ.
Case case_of(const std::vector<io::RunReader>& runs) {
  bool free_spin = false;
  Case first = case_of(runs.front(), free_spin);
  double most = first.motion.angular_velocity.largest();
  bool same = first.motion.angular_velocity.points().size() == 1;
  for (const io::RunReader& run : runs) {
    const Case c = case_of(run, free_spin);
    const std::string difference = body_difference(body_text(c), body_text(first));
    if (!difference.empty())
      throw request_error(
          "RUN", run.directory().string(),
          fmt::format("not the body of {}: {}", runs.front().directory().string(), difference),
          "runs of one mesh and material together");
    const double spin = c.motion.angular_velocity.largest();
    same = same && c.motion.angular_velocity.points().size() == 1 && spin == most;
    most = std::max(most, spin);
  }
  const double begin = first.motion.angular_velocity.at(0.0);  // stiffens the body, if anything
  if (free_spin || !same)
    first.motion.angular_velocity =
        dynamics::Table({{0.0, begin}, {1.0, begin < 0.0 ? -most : most}});
  return first;
}

void refuse_without_sectors(const io::RunReader& run, const PreparedWheel& wheel) {
  if (!wheel.whole) return;
  throw request_error("RUN", run.directory().string(),
                      "the mesh has no equal sectors, and the POD of a wheel is one of harmonics",
                      "eigenmodes: rondo reduce CASE.toml -o wheel.h5; or rondo pod, which "
                      "decomposes these runs");
}

/// The POD of all snapshots together, each once.
rom::PodModes pod_of(const ReduceRequest& r, const PodRequest& pod,
                     const std::vector<io::RunReader>& runs, const rom::Ring& ring,
                     ReduceReport& report) {
  const std::vector<SnapshotColumn> columns = columns_of(pod, snapshot_choice_of(pod), runs);
  rom::FieldHarmonics sum(ring);
  std::vector<Vec2> field(runs.front().mesh().n_nodes());
  for (const SnapshotColumn& column : columns) {
    if (r.progress) r.progress(report.snapshots, static_cast<long long>(columns.size()));
    runs[column.run].read(io::Quantity::displacement, column.snapshot, 0, field);
    const auto is_finite = [](Vec2 u) { return std::isfinite(u.x) && std::isfinite(u.y); };
    if (!std::ranges::all_of(field, is_finite))
      throw request_error(
          "RUN", runs[column.run].directory().string(),
          fmt::format("snapshot {} has numbers that are not finite", column.snapshot),
          "runs that did not fail, or a window --from, --to without it");
    sum.add(field);
    ++report.snapshots;
  }
  if (!(sum.energy() > 0.0))
    throw request_error("RUN", runs.front().directory().string(),
                        "every displacement is zero: nothing moves",
                        "runs in which the disk is loaded or spins");
  const long long wanted = r.modes.value_or(default_pod_modes);
  rom::PodModes found = sum.modes(static_cast<int>(wanted));
  if (const int n = rom::count_modes(found.harmonics); n < wanted && r.warn)
    r.warn(fmt::format("the snapshots have {} modes, fewer than the {} asked for", n, wanted));
  report.left = found.left;
  return found;
}

/// Writes the file and reports what is in it.
void finish(const ReduceRequest& r, const Case& c, const Setup& setup, const PreparedWheel& wheel,
            const std::vector<std::string>& behind, ReduceReport& report) {
  for (const std::string& text : wheel.warnings)
    if (r.warn) r.warn(text);
  write_wheel_file(r.output, c, setup, *wheel.ring, wheel.model, {wheel.basis, behind});
  report.basis = name_of(wheel.basis);
  report.dofs = 2 * static_cast<long long>(setup.model.free.size());
  report.modes = wheel.n_modes();
  report.highest = wheel.highest();
  for (const double square : wheel.model.squares) report.spins.push_back(std::sqrt(square));
  report.contact_nodes = static_cast<long long>(setup.model.contact->nodes.size());
  std::error_code error;
  report.file_bytes = std::filesystem::file_size(r.output, error);
}

/// A wheel with a width has its modes in seconds, and no file for them.
void refuse_width(const Case& c) {
  if (!c.section && !c.wheel.width) return;
  throw case_error(c, c.section ? "section" : "disk.width",
                   "the modes of a wheel in three dimensions are not kept in a file",
                   "rondo run CASE.toml --reduced, which finds them in seconds");
}

void reduce_case(const ReduceRequest& r, ReduceReport& report) {
  const Case c = read_case(r.sources.front(), r.settings);
  refuse_width(c);
  if (c.analysis.kind != AnalysisKind::dynamic)
    throw case_error(c, "analysis.kind", "a reduced wheel moves in time",
                     "\"dynamic\"; or run this case, and rondo reduce RESULTS --basis pod");
  Setup setup = build(c, 1, nullptr, Steps::of_reduced_wheel);
  PreparedWheel wheel;
  RunOptions options;
  options.reduced = wheel_of_case;
  options.reduced_modes = r.modes;
  prepare_wheel(c, options, {}, setup, wheel);
  finish(r, c, setup, wheel, {}, report);
}

void reduce_runs(const ReduceRequest& r, ReduceReport& report) {
  const PodRequest pod = pod_request(r);
  const std::vector<io::RunReader> runs = open_runs(pod, snapshot_choice_of(pod));
  const Case c = case_of(runs);
  refuse_width(c);
  Setup setup = build(c, 1, nullptr, Steps::of_reduced_wheel);
  PreparedWheel wheel;
  begin_wheel(c, {}, {}, setup, wheel);
  refuse_without_sectors(runs.front(), wheel);
  wheel.basis = WheelBasis::pod;
  rom::PodModes found = pod_of(r, pod, runs, *wheel.ring, report);
  complete_wheel(c, {}, std::move(found.harmonics), setup, wheel);
  std::vector<std::string> behind;
  for (const io::RunReader& run : runs) behind.push_back(run.directory().string());
  finish(r, c, setup, wheel, behind, report);
}

}  // namespace

ReduceReport run_reduce(const ReduceRequest& request) {
  const auto begin = Clock::now();
  const OneBlasThread one;  // the same wheel for any number of cores
  ReduceReport report;
  const WheelBasis basis = basis_of(request);
  check(request, basis);
  if (basis == WheelBasis::pod)
    reduce_runs(request, report);
  else
    reduce_case(request, report);
  report.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return report;
}

}  // namespace rondo::study
