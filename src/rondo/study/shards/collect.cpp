// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <set>
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

/// The data found in the shards.
struct Found {
  std::size_t count = 0;                      ///< number of shards of the sweep
  std::vector<ShardFile> files;               ///< of shards that have begun, ascending
  std::vector<std::size_t> shard_of;          ///< (members) from 1
  std::map<std::size_t, std::string> states;  ///< of unfinished shards, by their number
};

/// The number of shards of the sweep. @throws InputError
std::size_t count_of(const fs::path& directory, const std::vector<Shard>& shards) {
  if (shards.empty())
    io::refuse_directory(directory, "holds no shards of a sweep",
                         "rondo sweep STUDY --shard 1/n -o DIR, to n/n, before --collect");
  if (shards.front().count != shards.back().count)
    io::refuse_directory(
        directory,
        fmt::format("holds shards of sweeps in {} and in {} parts ({}, {})", shards.front().count,
                    shards.back().count, folder_name(shards.front()), folder_name(shards.back())),
        fmt::format("remove those in {} that do not belong to it",
                    (directory / shards_folder).string()));
  return shards.front().count;
}

/// @throws InputError: lists each shard that is of another sweep
void demand_same_sweep_of_all(const fs::path& directory, const std::vector<ShardFile>& files,
                              const SweepIdentity& identity) {
  std::vector<Fault> faults;
  for (const ShardFile& file : files) {
    const std::string what = difference(file.identity, identity);
    if (!what.empty())
      faults.push_back({"", 0, 0, "-o", directory.string(),
                        fmt::format("shard {} is of another sweep: {}", text_of(file.shard), what),
                        "collect with the study, the --set and the program that made the shards"});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

/// Whether no other program on this machine uses the directory; other machines are not known.
bool is_free(const fs::path& directory) {
  try {
    static_cast<void>(io::DirectoryLock(directory));
    return true;
  } catch (const FileError&) {
    return false;
  }
}

std::string state_of(const fs::path& directory, const ShardFile& file) {
  const std::string who = fmt::format("process {} on {}", file.process, file.host);
  if (file.status == "interrupted") return "was interrupted";
  if (file.host != io::host_name()) return fmt::format("is at work, or was killed ({})", who);
  return is_free(shard_directory(directory, file.shard)) ? fmt::format("was killed ({})", who)
                                                         : fmt::format("is at work ({})", who);
}

/// Checks that a finished shard has a row for each of its members, and no others. @throws FileError
void demand_whole(const fs::path& directory, const ShardFile& file, const Found& found,
                  std::size_t figures) {
  const auto own = static_cast<std::size_t>(std::ranges::count(found.shard_of, file.shard.number));
  bool right = file.status == "running" ? file.rows.empty() : file.rows.size() == own;
  std::vector<bool> seen(found.shard_of.size(), false);
  for (const auto& [member, row] : file.rows) {
    right = right && member < seen.size() && !seen[member] &&
            found.shard_of[member] == file.shard.number;
    if (!right) break;
    seen[member] = true;
    right = row.figures.size() == (row.status == MemberStatus::done ? figures : 0);
  }
  if (right) return;
  throw FileError(shard_directory(directory, file.shard).string(),
                  fmt::format("damaged: rows.json does not hold the {} runs of shard {}; remove "
                              "the folder and make the shard again",
                              own, text_of(file.shard)));
}

Found find_shards(const fs::path& directory, const SweepIdentity& identity,
                  const PlannedSweep& plan) {
  Found found;
  const std::vector<Shard> shards = shards_in(directory);
  found.count = count_of(directory, shards);
  for (const Shard& shard : shards)
    if (has_shard_file(directory, shard)) found.files.push_back(read_shard_file(directory, shard));
  demand_same_sweep_of_all(directory, found.files, identity);
  found.shard_of = divide(plan.members, found.count);
  for (std::size_t s = 1; s <= found.count; ++s) found.states[s] = "has not begun";
  for (const ShardFile& file : found.files) {
    demand_whole(directory, file, found, figure_labels(plan).size());
    if (file.status == "done" || file.status == "failed")
      found.states.erase(file.shard.number);
    else
      found.states[file.shard.number] = state_of(directory, file);
  }
  return found;
}

/// Compares bit for bit, so that NaN equals NaN.
bool same_figures(const MemberRow& a, const MemberRow& b) {
  return a.steps == b.steps && std::ranges::equal(a.figures, b.figures, [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

/// Compares a row of a shard with the existing run. A row without its run does not count.
void compare(std::size_t member, const std::optional<MemberRow>& there, Found& found,
             SweepRows& rows) {
  const MemberRow& told = rows.rows()[member];
  if (told.status == MemberStatus::done && !(there && same_figures(told, *there))) {
    found.states[found.shard_of[member]] =
        fmt::format("has lost run {}, which is not there as it was made", member + 1);
    rows.take(member, MemberRow{});
  } else if (there && told.status == MemberStatus::waiting) {
    rows.take(member, *there);
  }
}

/// Whether the member whose modes it starts with is missing: its shard then had its own fields.
bool is_ahead(std::size_t member, const PlannedSweep& plan, const SweepRows& rows) {
  const std::optional<std::size_t>& first = plan.members[member].modes_of;
  return first && is_unfinished(rows.rows()[*first]);
}

/// Compares rows with runs, by the whole team, starting with those whose modes others use.
/// False: a stop was requested.
bool check_runs(const MemberRunner& runner, Team& team, Found& found, SweepRows& rows) {
  for (std::vector<std::size_t> members : phases_of(runner.plan)) {
    std::erase_if(members, [&](std::size_t m) { return is_ahead(m, runner.plan, rows); });
    TeamWork work;
    work.count = members.size();
    work.work = [&](std::size_t k, const std::atomic<bool>&) {
      const std::optional<MemberRow> row = kept_row(runner, members[k]);
      return row ? packed(*row) : std::string();
    };
    const std::vector<Piece> pieces = team.each(work);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (pieces[k].state == Piece::State::missing) return false;
      demand_done(pieces[k]);
      std::optional<MemberRow> there;
      if (!pieces[k].text.empty()) there = unpacked(pieces[k].text);
      compare(members[k], there, found, rows);
    }
  }
  return true;
}

void take_rows(const Found& found, SweepRows& rows) {
  double wall = 0.0;
  for (const ShardFile& file : found.files) {
    for (const auto& [member, row] : file.rows) rows.take(member, row);
    wall = std::max(wall, file.wall_s);
  }
  rows.set_wall(wall);
}

/// A shard whose runs all exist has nothing left to do, however it ended.
CollectReport report_of(const SweepRows& rows, const Found& found) {
  CollectReport report;
  static_cast<SweepReport&>(report) = rows.report();
  report.shards = found.count;
  std::set<std::size_t> unfinished;
  for (std::size_t m = 0; m < rows.rows().size(); ++m)
    if (is_unfinished(rows.rows()[m])) unfinished.insert(found.shard_of[m]);
  for (const std::size_t number : unfinished) {
    report.unfinished.push_back({number, found.count});
    report.states.push_back(found.states.at(number));
  }
  return report;
}

}  // namespace

CollectReport collect_shards(const SweepRequest& request, Team& team) {
  const SweepStudy study = study_of(request);
  const auto none = [](std::vector<PlannedMember>& members) {
    for (PlannedMember& member : members) member.part = Part::other;  // nothing is built
  };
  PlannedSweep plan = plan_sweep({study, false, request.checking, none, request.accept}, team);
  for (PlannedMember& member : plan.members) member.part = Part::own;
  const fs::path& directory = request.directory;
  const SweepIdentity identity = identity_of(request, study, plan);
  Found found = find_shards(directory, identity, plan);
  std::error_code error;
  if (fs::exists(directory / "sweep.json", error))
    demand_same_sweep(directory, identity.members_hash, "");
  else
    refuse_foreign_files(directory, false);
  if (request.before_files) request.before_files();
  const io::DirectoryLock lock(directory);
  SweepRows rows(request, study, plan);
  take_rows(found, rows);
  const MemberRunner runner{study, plan, directory, {}, rows.rows(), {}, {}};
  CollectReport report;
  if (!plan.direct && !check_runs(runner, team, found, rows)) {
    static_cast<SweepReport&>(report) = interrupted_report(plan);
    return report;
  }
  report = report_of(rows, found);
  rows.write("running");
  rows.write_tables();
  rows.write(status_of(report));
  return report;
}

}  // namespace rondo::study
