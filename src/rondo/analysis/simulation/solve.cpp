// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/simulation/solve.hpp"

#include <fmt/format.h>

#include "rondo/analysis/registry.hpp"
#include "rondo/analysis/run_session.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/limits/memory_limits.hpp"

namespace rondo::study {
namespace {

void demand_snapshots_fit(const Case& c, const RecordPlan& plan) {
  const std::size_t needed =
      memory_of_snapshots(plan) + plan.n_rows * plan.columns.size() * sizeof(double);
  const AllowedMemory allowed = allowed_memory();
  if (needed <= allowed.bytes) return;
  throw case_error(
      c, "output.snapshots",
      fmt::format("{} snapshots take {} of memory, and {} {}", plan.results.n_snapshots,
                  readable_bytes(needed), allowed.source, readable_bytes(allowed.bytes)),
      "fewer snapshots, a longer output.history_interval, or a results directory "
      "to write them into");
}

}  // namespace

Solution solve_case(const Case& c, const RunOptions& options) {
  static_cast<void>(dispatch_level());  // a wrong one is told before anything is built
  RunOptions in_memory = options;
  in_memory.directory.clear();
  const std::unique_ptr<Analysis> analysis = make_analysis(c, in_memory);
  const RecordPlan plan = analysis->record_plan();
  demand_snapshots_fit(c, plan);
  MemoryRecorder recorder(plan, true);
  RunSession session(*analysis, c, in_memory, &recorder);
  while (!session.is_over()) session.advance();
  Solution solution;
  solution.report = session.finish();
  solution.json = session.json();
  if (plan.results.mesh) solution.mesh = *plan.results.mesh;
  solution.mass.assign(plan.results.mass.begin(), plan.results.mass.end());
  solution.free_body.assign(plan.results.free_body.begin(), plan.results.free_body.end());
  solution.columns = plan.columns;
  solution.rows = std::move(recorder.rows());
  solution.snapshots = std::move(recorder.snapshots());
  return solution;
}

}  // namespace rondo::study
