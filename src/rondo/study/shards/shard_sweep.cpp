// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "rondo/core/error.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/study/shards/shard_file.hpp"
#include "rondo/study/shards/shard_sweep.hpp"
#include "rondo/study/sweep/member_run.hpp"
#include "rondo/study/sweep/sweep_directory.hpp"
#include "rondo/study/sweep/sweep_rows.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

/// Checks that other shards there have the same division and sweep. @throws InputError, FileError
void demand_same_shards(const fs::path& directory, const Shard& shard,
                        const SweepIdentity& identity) {
  for (const Shard& other : shards_in(directory)) {
    if (other.count != shard.count)
      io::refuse_directory(
          directory,
          fmt::format("holds shard {} of a sweep in {} parts, and --shard {} asks for {} parts",
                      text_of(other), other.count, text_of(shard), shard.count),
          fmt::format("--shard i/{}, or choose another -o", other.count));
    if (!has_shard_file(directory, other)) continue;
    const std::string what = difference(read_shard_file(directory, other).identity, identity);
    if (!what.empty())
      io::refuse_directory(directory,
                           fmt::format("holds shard {} of another sweep: {}", text_of(other), what),
                           "choose another -o, or remove the directory");
  }
}

/// Checks that a sweep there has the same members, was collected from shards, and is not running.
/// @throws InputError, FileError
void demand_collected(const fs::path& directory, const std::string& hash) {
  std::error_code error;
  if (!fs::exists(directory / "sweep.json", error)) return;
  if (!fs::exists(directory / shards_folder, error))
    io::refuse_directory(directory, "holds a sweep that was not made in shards",
                         "--resume without --shard, or choose another -o");
  demand_same_sweep(directory, hash, "");
  static_cast<void>(io::DirectoryLock(directory));
}

/// Creates the shard's folder. @throws InputError, FileError
void prepare_shard(const fs::path& directory, const Shard& shard, const SweepIdentity& identity) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    io::refuse_directory(directory, "is there and is not a directory", "choose another -o");
  if (!fs::exists(directory / "sweep.json", error)) {
    const bool runs = fs::exists(directory / "runs", error);  // in this order: others may start
    refuse_foreign_files(directory, runs && !fs::exists(directory / shards_folder, error));
  }
  demand_collected(directory, identity.members_hash);
  demand_same_shards(directory, shard, identity);
  make_directory(shard_directory(directory, shard));
  try {
    demand_same_shards(directory, shard, identity);  // again: others may have begun meanwhile
  } catch (const InputError&) {
    fs::remove(shard_directory(directory, shard), error);  // if it is empty
    throw;
  }
}

void demand_new(const SweepRequest& request, const Shard& shard) {
  if (!request.resume && has_shard_file(request.directory, shard))
    io::refuse_directory(request.directory, fmt::format("holds shard {}", text_of(shard)),
                         "give --resume to continue it, or choose another -o");
}

ShardFile file_of(const Shard& shard, const char* status, const SweepIdentity& identity) {
  ShardFile file;
  file.shard = shard;
  file.status = status;
  file.identity = identity;
  return file;
}

/// The leader's part before the runs. The shard is locked as long as the lock exists.
std::optional<io::DirectoryLock> begin(const SweepRequest& request, const Shard& shard,
                                       const SweepIdentity& identity, const PlannedSweep& plan,
                                       Team& team) {
  std::optional<io::DirectoryLock> lock;
  if (request.before_files) request.before_files();
  lead(team, [&] {
    prepare_shard(request.directory, shard, identity);
    lock.emplace(shard_directory(request.directory, shard));
    demand_new(request, shard);
    warn_of_another_host(request, shard_directory(request.directory, shard));
    demand_room(request, plan);
    write_shard_file(request.directory, file_of(shard, "running", identity));
    warn_of_members(request, plan);
    if (request.begin) request.begin(plan, team.workers());
  });
  return lock;
}

MembersRequest members_request(const SweepRequest& request, const SweepStudy& study,
                               const Shard& shard, bool seconds) {
  return {study, seconds, request.checking,
          [shard](std::vector<PlannedMember>& members) { choose_members(members, shard); },
          request.accept};
}

void end(const SweepRequest& request, ShardFile file, const SweepRows& rows,
         const PlannedSweep& plan, const SweepReport& report) {
  for (std::size_t m = 0; m < plan.members.size(); ++m)
    if (plan.members[m].part == Part::own) file.rows.emplace_back(m, rows.rows()[m]);
  file.wall_s = report.wall_s;
  write_shard_file(request.directory, file);
}

}  // namespace

DrySweep check_shard(const SweepRequest& request, const Shard& shard, Team& team) {
  DrySweep dry{study_of(request), {}};
  dry.plan = plan_sweep(members_request(request, dry.study, shard, true), team);
  return dry;
}

SweepReport run_shard(const SweepRequest& request, const Shard& shard, Team& team) {
  const SweepStudy study = study_of(request);
  const PlannedSweep plan = plan_sweep(members_request(request, study, shard, false), team);
  if (plan.stopped) return interrupted_report(plan);
  const SweepIdentity identity = identity_of(request, study, plan);
  SweepRows rows(request, study, plan);
  const std::optional<io::DirectoryLock> lock = begin(request, shard, identity, plan, team);
  MemberRunner runner{
      study,       plan, request.directory, shard_directory(request.directory, shard), rows.rows(),
      team.tick(), {}};
  run_members(request, runner, team, rows);
  if (team.leads()) rows.compare_with_files(runner);
  const SweepReport report = rows.report();
  if (team.leads()) end(request, file_of(shard, status_of(report), identity), rows, plan, report);
  return report;
}

}  // namespace rondo::study
