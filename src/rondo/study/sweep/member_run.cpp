// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/member_run.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "rondo/analysis/run.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/checkpoint.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/kept_runs.hpp"
#include "rondo/study/sweep/sweep_directory.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

/// Reads run.json and history.csv of a run that has ended.
MemberRow row_of(const fs::path& directory, const MemberRunner& runner) {
  const Json j = io::read_json(directory / "run.json");
  MemberRow row;
  row.status = text_in(j, "status") == "done" ? MemberStatus::done : MemberStatus::failed;
  row.message = text_in(j, "message");
  row.code = row.status == MemberStatus::done ? exit_done : exit_numerical;
  row.steps = static_cast<long long>(number_in(j, "steps_done"));
  row.end_time = std::max(0.0, number_in(j, "end_time"));
  row.wall_s = std::max(0.0, number_in(j, "total_wall_s"));
  if (row.status != MemberStatus::done) return row;
  const FigureTable& table = runner.plan.type->figures;
  row.figures = table.of(directory, runner.study.window);
  const std::vector<double> chosen =
      values_of(runner.plan.chosen, directory, runner.study.window, table.has_window);
  row.figures.insert(row.figures.end(), chosen.begin(), chosen.end());
  return row;
}

MemberRow interrupted_row(const fs::path& directory, const MemberRunner& runner) {
  MemberRow row = row_of(directory, runner);
  row.status = MemberStatus::interrupted;
  row.code = exit_interrupted;
  return row;
}

MemberRow direct_row(MemberRunner& runner, const Case& c, const std::atomic<bool>& stop) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  RunOptions options;
  options.threads = 1;
  options.stop = &stop;
  options.shared = &runner.shared;
  DirectRun run = runner.plan.type->direct(c, options);
  MemberRow row;
  row.status = run.trouble.empty() ? MemberStatus::done : MemberStatus::failed;
  row.code = run.trouble.empty() ? exit_done : exit_numerical;
  row.message = std::move(run.trouble);
  row.steps = run.steps;
  row.figures = std::move(run.figures);
  row.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return row;
}

/// Whether a run of this case and this program was killed or interrupted there and its checkpoint
/// is intact; otherwise the member is run again.
bool can_go_on(const fs::path& directory, const Case& c) {
  try {
    const Json j = io::read_json(directory / "run.json");
    if (text_in(j, "status") == "done" || !j.value("resumable", false) || !is_of_this_program(j) ||
        !is_case_of(directory, c))
      return false;
    if (fs::exists(directory / checkpoint_name))
      demand_kept(directory, read_checkpoint(directory).files);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

fs::path directory_of(const MemberRunner& runner, std::size_t member) {
  const bool lent = runner.plan.members[member].part == Part::lent;
  return run_directory(lent ? runner.lent_directory : runner.directory, member,
                       runner.plan.members.size());
}

/// Directory and name of the modes with which a member starts, wherever the sweep is.
struct ModesOfMember {
  fs::path from;
  std::string told;
};

ModesOfMember modes_of(const MemberRunner& runner, std::size_t member) {
  const std::optional<std::size_t>& first = runner.plan.members[member].modes_of;
  if (!first || runner.rows[*first].status != MemberStatus::done) return {};
  const fs::path from = directory_of(runner, *first);
  return {from, "../" + from.filename().string()};
}

RunStatus make(MemberRunner& runner, std::size_t member, const Case& c,
               const std::atomic<bool>& stop) {
  const fs::path directory = directory_of(runner, member);
  remove_unfinished(directory);
  ModesOfMember modes = modes_of(runner, member);
  RunOptions options;
  options.directory = directory;
  options.threads = 1;
  options.resume = can_go_on(directory, c);
  options.overwrite = !options.resume;
  options.stop = &stop;
  options.shared = &runner.shared;
  options.keeps_checkpoint = false;
  options.modes_from = std::move(modes.from);
  options.modes_told = std::move(modes.told);
  if (runner.tick) options.progress = [&](long long, long long) { runner.tick(); };
  return run_case(c, options).status;
}

std::optional<MemberRow> row_there(const MemberRunner& runner, std::size_t member, const Case& c) {
  const fs::path directory = directory_of(runner, member);
  if (!run_is_there(directory, c, modes_of(runner, member).told)) return std::nullopt;
  MemberRow row = row_of(directory, runner);
  row.kept = true;
  return row;
}

}  // namespace

MemberRow run_member(MemberRunner& runner, std::size_t member, const std::atomic<bool>& stop) {
  const Case c = case_of(runner.study, runner.plan.members[member]);
  if (runner.plan.direct) return direct_row(runner, c, stop);
  if (std::optional<MemberRow> row = row_there(runner, member, c)) return *std::move(row);
  const RunStatus status = make(runner, member, c, stop);
  const fs::path directory = directory_of(runner, member);
  return status == RunStatus::interrupted ? interrupted_row(directory, runner)
                                          : row_of(directory, runner);
}

std::string missing_file(const fs::path& sweep, std::size_t member, std::size_t n) {
  const fs::path directory = run_directory(sweep, member, n);
  std::error_code error;
  if (!fs::exists(directory, error)) return directory.string();
  for (const char* name : {"run.json", "case.toml", "history.csv", "results.h5"})
    if (!fs::exists(directory / name, error)) return (directory / name).string();
  return {};
}

std::optional<MemberRow> kept_row(const MemberRunner& runner, std::size_t member) {
  std::error_code error;  // before the case is read, which takes longer
  if (!fs::exists(directory_of(runner, member) / "run.json", error)) return std::nullopt;
  return row_there(runner, member, case_of(runner.study, runner.plan.members[member]));
}

}  // namespace rondo::study
