// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/pod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "rondo/io/files.hpp"
#include "rondo/study/estimate.hpp"
#include "rondo/study/pod_input.hpp"
#include "rondo/study/pod_output.hpp"
#include "rondo/study/pod_report.hpp"
#include "rondo/study/run_files.hpp"

namespace rondo::study {
namespace {

using reduction::Index;
using Clock = std::chrono::steady_clock;

/// Speed of the matrix work of a decomposition on this machine, from a small one [flop/s]. The
/// first one also wakes the library up, so the second is timed.
double measured_speed() {
  constexpr Index rows = 3000, columns = 200;
  Eigen::MatrixXd values(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i)
      values(i, j) = std::sin(static_cast<double>(i * (j + 1) + j));
  reduction::DenseSnapshots snapshots(std::move(values));
  reduction::DecomposeOptions options;
  options.modes = columns;
  double seconds = 0.0;
  for (int k = 0; k < 2; ++k) {
    const auto begin = Clock::now();
    static_cast<void>(reduction::decompose(snapshots, options));  // only its time is of interest
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return reduction::plan(rows, columns, 1, options).flops / std::max(1e-6, seconds);
}

void say_plan(const PodRequest& request, const reduction::DecomposePlan& plan, Index rows,
              Index columns) {
  const auto bytes =
      static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) * sizeof(double);
  if (request.say)
    request.say(fmt::format("{} x {} numbers ({}): {}, about {} of memory and {:.2g} s", rows,
                            columns, readable_bytes(bytes), name_of(plan.method),
                            readable_bytes(plan.memory), plan.flops / measured_speed()));
  if (request.warn && plan.memory > request.memory)
    request.warn(fmt::format("{} are not enough: about {} will be used (--memory)",
                             readable_bytes(request.memory), readable_bytes(plan.memory)));
}

/// As many as make some tens of megabytes.
Index columns_at_once(Index rows) {
  constexpr Index numbers = 1 << 22, most = 32;
  return std::clamp<Index>(numbers / rows, 1, most);
}

reduction::Decomposition decompose_snapshots(const PodRequest& request, RunSnapshots& snapshots,
                                             PodReport& report) {
  reduction::DecomposeOptions options;
  options.method = method_of(request);
  options.memory = request.memory;
  options.modes = static_cast<Index>(request.modes.value_or(-1));
  options.progress = request.progress;
  const auto plan =
      reduction::plan(snapshots.rows(), snapshots.columns(), snapshots.row_grain(), options);
  report.memory_estimate = plan.memory;
  say_plan(request, plan, snapshots.rows(), snapshots.columns());
  reduction::Decomposition d = decompose(snapshots, options);
  report.method = name_of(d.method);
  if (request.warn && d.rank == 0) request.warn("all snapshots are zero: there are no modes");
  if (request.warn && d.rank > 0 && request.modes && *request.modes > d.modes.cols())
    request.warn(fmt::format("{} modes asked for; the snapshots have rank {}: {} kept",
                             *request.modes, d.rank, d.modes.cols()));
  if (request.warn && d.sigma_bound > 10.0 * options.tolerance * std::sqrt(d.energy))
    request.warn(
        fmt::format("the memory allowed holds {} modes only: singular values are right to "
                    "{:.1e} of the first; more with --memory",
                    d.sigma.size(), d.sigma_bound / d.sigma[0]));
  return d;
}

}  // namespace

PodReport run_pod(const PodRequest& request) {
  const auto begin = Clock::now();
  const SnapshotChoice choice = choice_of(request);
  PodReport report;
  report.directory = directory_of(request);
  const std::vector<io::RunReader> runs = open_runs(request, choice);
  PodResult found;
  found.columns = columns_of(request, choice, runs);
  RunSnapshots snapshots(runs, found.columns, choice);
  report.runs = describe_runs(runs, found.columns);
  report.weight = name_of(choice.weight);
  report.unit = unit_of(choice.quantity);
  report.rows = static_cast<std::size_t>(snapshots.rows());
  report.snapshots = found.columns.size();

  found.d = decompose_snapshots(request, snapshots, report);
  found.spectrum = reduction::spectrum(found.d);
  found.identity = check_identity(snapshots, found.d, columns_at_once(snapshots.rows()));
  add_figures(report, found);
  write_pod_files(request, report, snapshots, found);
  report.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  report.peak_memory = static_cast<std::size_t>(peak_memory_bytes());
  io::write_json(report.directory / "pod.json", as_json(request, report));
  return report;
}

}  // namespace rondo::study
