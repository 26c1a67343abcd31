// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep.hpp"

#include <optional>

#include "rondo/core/error.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/study/sweep/member_run.hpp"
#include "rondo/study/sweep/sweep_directory.hpp"
#include "rondo/study/sweep/sweep_rows.hpp"

namespace rondo::study {
namespace {

/// The leader holds the directory as long as the lock exists.
std::optional<io::DirectoryLock> begin(const SweepRequest& request, const SweepRows& rows,
                                       const SweepStudy& study, const PlannedSweep& plan,
                                       Team& team) {
  std::optional<io::DirectoryLock> lock;
  if (request.before_files) request.before_files();
  lead(team, [&] {
    prepare_sweep(request, hash_of(study, plan));
    lock.emplace(request.directory);
    warn_of_another_host(request, request.directory);
    demand_room(request, plan);  // before any file is removed
    rows.write("running");       // shows others that a sweep is running if there are no locks
    clear_sweep(request);
    warn_of_members(request, plan);
    if (request.begin) request.begin(plan, team.workers());
  });
  return lock;
}

}  // namespace

DrySweep check_sweep(const SweepRequest& request, Team& team) {
  DrySweep dry{study_of(request), {}};
  dry.plan = plan_sweep({dry.study, true, request.checking, {}, request.accept}, team);
  return dry;
}

SweepReport run_sweep(const SweepRequest& request, Team& team) {
  const SweepStudy study = study_of(request);
  const PlannedSweep plan = plan_sweep({study, false, request.checking, {}, request.accept}, team);
  if (plan.stopped) return interrupted_report(plan);
  SweepRows rows(request, study, plan);
  const std::optional<io::DirectoryLock> lock = begin(request, rows, study, plan, team);
  MemberRunner runner{study, plan, request.directory, {}, rows.rows(), team.tick(), {}};
  run_members(request, runner, team, rows);
  if (team.leads()) rows.compare_with_files(runner);
  const SweepReport report = rows.report();
  if (team.leads()) {
    rows.write_tables();
    rows.write(status_of(report));
  }
  return report;
}

}  // namespace rondo::study
