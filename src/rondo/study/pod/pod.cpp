// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/pod/pod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "rondo/core/bytes.hpp"
#include "rondo/core/limits/memory_limits.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/pod/pod_input.hpp"
#include "rondo/study/pod/pod_output.hpp"
#include "rondo/study/pod/pod_report.hpp"

namespace rondo::study {
namespace {

using pod::Index;
using Clock = std::chrono::steady_clock;

/// Speed of the matrix operations of a decomposition on this machine, from a small one [flop/s].
/// The first run also initialises the library, so the second is timed.
double measured_speed() {
  constexpr Index rows = 3000, columns = 200;
  Eigen::MatrixXd values(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i) values(i, j) = std::sin(static_cast<double>(i * (j + 1) + j));
  pod::DenseSnapshots snapshots(std::move(values));
  pod::DecomposeOptions options;
  options.modes = columns;
  double seconds = 0.0;
  for (int k = 0; k < 2; ++k) {
    const auto begin = Clock::now();
    static_cast<void>(pod::decompose(snapshots, options));  // only its duration matters
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return pod::plan(rows, columns, 1, options).flops / std::max(1e-6, seconds);
}

void say_plan(const PodRequest& request, const pod::DecomposePlan& plan, Index rows,
              Index columns) {
  const auto bytes =
      static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) * sizeof(double);
  if (request.say)
    request.say(
        fmt::format("{} x {} numbers ({}): {}, about {} of memory besides the program's own, "
                    "and {:.2g} s",
                    rows, columns, readable_bytes(bytes), name_of(plan.method),
                    readable_bytes(plan.memory), plan.flops / measured_speed()));
  const AllowedMemory allowed = allowed_memory();
  if (plan.memory > allowed.bytes)
    throw request_error(
        "--memory", request.memory,
        fmt::format("about {} are needed at least, and {} {}", readable_bytes(plan.memory),
                    allowed.source, readable_bytes(allowed.bytes)),
        "fewer snapshots (--from, --to), --method incremental with fewer --modes");
  if (request.warn && plan.memory > memory_of(request))
    request.warn(fmt::format("{} are not enough: about {} will be used (--memory)",
                             readable_bytes(memory_of(request)), readable_bytes(plan.memory)));
}

/// Warns if the result has less than the user may expect.
void warn_of_limits(const PodRequest& request, const PodReport& r, double tolerance) {
  if (!request.warn) return;
  if (request.frame == "rotating" && request.shift != PodRequest{}.shift)
    request.warn("--shift has no effect in the co-rotating frame");
  if (r.rank == 0) return request.warn("all snapshots are zero: there are no modes");
  if (request.modes && *request.modes > r.modes)
    request.warn(r.rank_is_known && r.modes == r.rank
                     ? fmt::format("{} modes asked for; the snapshots have rank {}: {} kept",
                                   *request.modes, r.rank, r.modes)
                     : fmt::format("{} modes asked for; the memory allowed holds {}: more with "
                                   "--memory",
                                   *request.modes, r.modes));
  else if (!request.modes && r.modes < std::max(r.counts.back().modes, 1LL))
    request.warn(
        fmt::format("the memory allowed holds {} modes; {} would leave {:.0e} of the energy: "
                    "more with --memory",
                    r.modes, r.counts.back().modes, r.counts.back().discarded));
  if (r.sigma_bound > 10.0 * tolerance)
    request.warn(
        fmt::format("the memory allowed holds {} modes only: singular values are right to "
                    "{:.1e} of the first; more with --memory",
                    r.rank, r.sigma_bound));
}

/// Relevant only if the user chose the method, because no such method is chosen automatically.
void refuse_too_long(const PodRequest& request, pod::Method method, const RunSnapshots& snapshots) {
  if (method != pod::Method::direct && method != pod::Method::tsqr) return;
  const Index side = std::min(snapshots.rows(), snapshots.columns());
  if (side <= pod::largest_side) return;
  throw request_error("--method", request.method,
                      fmt::format("{} is too long for the shorter side of the snapshots", side),
                      fmt::format("auto | incremental; up to {} this one", pod::largest_side));
}

pod::DecomposeOptions options_of(const PodRequest& request) {
  pod::DecomposeOptions options;
  options.method = method_of(request);
  options.memory = memory_of(request);
  options.modes = static_cast<Index>(request.modes.value_or(-1));
  return options;
}

/// Decomposition and error identity; the progress of both is counted in numbers read.
void find(const PodRequest& request, RunSnapshots& snapshots, PodResult& found) {
  const long long all = static_cast<long long>(snapshots.rows()) * snapshots.columns();
  long long done = 0, total = 0;
  pod::DecomposeOptions options = options_of(request);
  if (request.progress)
    options.progress = [&](long long d, long long of) {
      done = d;
      total = of + all;
      request.progress(done, total);
    };
  found.d = decompose(snapshots, options);
  found.spectrum = pod::spectrum(found.d);
  // Reads some tens of megabytes at once, or as much as is allowed.
  const auto numbers =
      std::min<Index>(Index{1} << 22, static_cast<Index>(options.memory / sizeof(double) / 4));
  pod::IdentityOptions identity;
  identity.block = std::clamp<Index>(numbers / snapshots.rows(), 1, 32);
  identity.fewer = kept_counts(found.spectrum, found.d.modes.cols());
  if (request.progress)
    identity.progress = [&](long long read) { request.progress(done += read, total); };
  found.identity = check_identity(snapshots, found.d, identity);
}

}  // namespace

PodReport run_pod(const PodRequest& asked) {
  const auto begin = Clock::now();
  PodRequest request = with_members(asked);
  request.frame = is_co_rotating(asked.frame, asked.warn) ? "rotating" : "rectified";
  const SnapshotChoice choice = snapshot_choice_of(request);
  const pod::DecomposeOptions options = options_of(request);
  const std::vector<io::RunReader> runs = open_runs(request, choice);
  PodResult found;
  found.columns = columns_of(request, choice, runs);
  RunSnapshots snapshots(runs, found.columns, choice);
  PodReport report;
  report.directory = make_directory(request);
  report.runs = describe_runs(runs, found.columns);
  report.weight = name_of(choice.weight);
  report.unit = unit_of(choice.quantity, runs.front());
  report.time_unit = runs.front().time_unit();
  report.rows = static_cast<std::size_t>(snapshots.rows());
  report.snapshots = found.columns.size();
  refuse_too_long(request, options.method, snapshots);
  const auto plan =
      pod::plan(snapshots.rows(), snapshots.columns(), snapshots.row_grain(), options);
  report.memory_estimate = plan.memory;
  say_plan(request, plan, snapshots.rows(), snapshots.columns());

  find(request, snapshots, found);
  report.method = name_of(found.d.method);
  add_figures(report, found);
  warn_of_limits(request, report, options.tolerance);
  report.trouble = trouble_in(report);
  write_pod_files(request, report, snapshots, found);
  report.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  report.peak_memory = static_cast<std::size_t>(peak_memory_bytes());
  io::write_json(report.directory / "pod.json", as_json(request, report));
  return report;
}

}  // namespace rondo::study
