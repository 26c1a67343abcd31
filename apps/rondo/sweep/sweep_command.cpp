// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

#include "default_directory.hpp"
#include "documents/documents.hpp"
#include "progress.hpp"
#include "report/axes_option.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/limits/processors.hpp"
#include "signals.hpp"
#include "sweep/mpi_team.hpp"
#include "sweep/sweep_shards.hpp"

namespace rondo::app {
namespace {

/// With fewer members, the check finishes before a progress bar would be seen.
constexpr long long spoken_of = 500;

/// Refuses tasks of a scheduler without MPI, because each would run the whole sweep.
void refuse_tasks_without_mpi() {
  const char* task = std::getenv("SLURM_PROCID");
  if (task != nullptr && std::string_view(task) != "0")
    throw InputError(Fault{"rondo sweep", 0, 0, "", "",
                           fmt::format("is task {} of a job, and MPI was not started", task),
                           "srun --mpi=pmix, or mpirun"});
}

/// Prints the cost that each run would have.
void print_plan(const study::DrySweep& dry, int workers) {
  double seconds = 0.0, longest = 0.0;
  std::size_t disk = 0, runs = 0;
  for (std::size_t m = 0; m < dry.plan.members.size(); ++m) {
    const study::PlannedMember& member = dry.plan.members[m];
    if (member.part == study::Part::other) continue;
    ++runs;
    const bool lent = member.part == study::Part::lent;
    const std::string time =
        member.seconds > 0.0 ? fmt::format(", about {:.2g} s", member.seconds) : "";
    fmt::print("{}: {} nodes, {} {}{}{}{}\n", study::name_of(dry.study, member.member, m + 1),
               member.nodes, member.steps, dry.plan.type->unit, member.steps == 1 ? "" : "s", time,
               lent ? ", of another shard, made here for its fields" : "");
    seconds += member.seconds;
    longest = std::max(longest, member.seconds);
    disk += member.disk_bytes;
  }
  const std::string time = seconds > 0.0
                               ? fmt::format("about {:.3g} s", std::max(longest, seconds / workers))
                               : std::string("the time is not estimated");
  fmt::print("{} runs, {} at once: {}, {} on the disk\n", runs, workers, time,
             readable_bytes(disk));
}

void tell_beginning(const study::PlannedSweep& plan, const std::optional<study::Shard>& shard,
                    int workers) {
  const auto count = [&](study::Part part) {
    return std::ranges::count(plan.members, part, &study::PlannedMember::part);
  };
  if (!shard) return spdlog::info("{} runs, {} at once", plan.members.size(), workers);
  const auto lent = count(study::Part::lent);
  spdlog::info("shard {}: {} of {} runs, {} at once{}", study::text_of(*shard),
               count(study::Part::own), plan.members.size(), workers,
               lent == 0 ? ""
                         : fmt::format("; {} of other shards made here as well, for {} fields",
                                       lent, lent == 1 ? "its" : "their"));
}

/// Stores the result for the document.
void keep(Telling& tell, const study::SweepReport& report, const std::filesystem::path& directory) {
  tell.result = sweep_document(report, directory);
  if (report.interrupted > 0)
    tell.end = fmt::format("interrupted with {} of {} runs done", report.done, report.members);
  else if (report.failed > 0)
    tell.end = fmt::format("{} of {} runs failed", report.failed, report.members);
}

int finish(const study::SweepReport& report, const std::filesystem::path& directory) {
  warn_of_runs(report, (directory / "sweep.json").string());
  if (report.interrupted > 0) {
    spdlog::warn("interrupted with {} of {} runs done; continue with --resume", report.done,
                 report.members);
    return exit_interrupted;
  }
  spdlog::info("{} of {} runs done{}{} in {:.1f} s; results.csv and sweep.h5 in {}", report.done,
               report.members, report.failed > 0 ? fmt::format(", {} failed", report.failed) : "",
               report.kept > 0 ? fmt::format(", {} were there already", report.kept) : "",
               report.wall_s, directory.string());
  return report.code;
}

int finish_dry(const study::DrySweep& dry, const study::Team& team, Telling& tell) {
  if (dry.plan.stopped) {
    tell.end = "interrupted";
    return exit_interrupted;
  }
  if (tell.json)
    tell.result = plan_document(dry, team.workers());
  else if (team.leads())
    print_plan(dry, team.workers());
  return exit_done;
}

int run(SweepArguments& arguments, study::Team& team, Telling& tell) {
  study::SweepRequest& request = arguments.request;
  const std::optional<study::Shard> shard = asked_shard(arguments);
  if (request.directory.empty())
    request.directory = request.resume && arguments.shard.empty()
                            ? resumed_directory(request.study, "sweep.json")
                            : default_directory(request.study);
  request.stop = &stop_requested();
  request.warn = [](const std::string& text) { spdlog::warn("{}", text); };
  std::optional<Progress> progress;
  const bool quiet = tell.quiet || !team.leads();
  request.checking = [&](const char* what, long long done, long long all) {
    if (quiet || all < spoken_of) return;
    if (done == 0 || !progress) progress.emplace(what);
    (*progress)(done, all);
    if (done == all) progress.reset();
  };
  if (arguments.dry_run) {
    const study::DrySweep dry =
        shard ? study::check_shard(request, *shard, team) : study::check_sweep(request, team);
    progress.reset();
    return finish_dry(dry, team, tell);
  }
  if (arguments.collect) {
    const study::CollectReport report = study::collect_shards(request, team);
    progress.reset();
    if (tell.json) keep_collected(tell, report, request.directory);
    return write_axes(request.directory, arguments.axes, finish_collected(report, request), tell);
  }
  request.begin = [&](const study::PlannedSweep& plan, int workers) {
    progress.reset();
    tell_beginning(plan, shard, workers);
    if (!quiet) progress.emplace("run");
  };
  request.progress = [&](long long ended, long long all) {
    if (progress) (*progress)(ended, all);
  };
  const study::SweepReport report =
      shard ? study::run_shard(request, *shard, team) : study::run_sweep(request, team);
  progress.reset();
  if (tell.json) keep(tell, report, request.directory);
  if (!team.leads()) return exit_done;  // mpirun returns the leader's code
  if (shard) return finish_shard(report, *shard, request);
  return write_axes(request.directory, arguments.axes, finish(report, request.directory), tell);
}

/// An error on all ranks is reported by the leader alone, as for any command. An error on some
/// ranks ends the others, which wait for them.
int run_ranks(SweepArguments& arguments, study::Team& team, Telling& tell) {
  try {
    return run(arguments, team, tell);
  } catch (const std::exception& error) {
    if (team.have_all_failed()) {
      if (!team.leads()) return exit_done;
      throw;
    }
    spdlog::set_level(spdlog::level::info);
    const study::WorkerOutcome failed = study::failed_by(error);
    spdlog::error("rank {}: {}", team.rank(), failed.text);
    team.abort(failed.code);
    return failed.code;
  }
}

}  // namespace

int sweep(SweepArguments arguments, Telling& tell) {
  if (tell.quiet) spdlog::set_level(spdlog::level::warn);
  if (!is_started_by_mpi()) {
    refuse_tasks_without_mpi();
    demand_axes(arguments);
    arguments.request.before_files = catch_stop_signals;
    const int workers = arguments.jobs > 0 ? arguments.jobs : allowed_processors();
    study::LocalTeam team(workers, &stop_requested());
    return run(arguments, team, tell);
  }
  if (arguments.collect)
    throw InputError(Fault{"--collect", 0, 0, "", "", "is done by one process",
                           "rondo sweep STUDY --collect, without mpirun or srun"});
  if (!arguments.axes.empty())
    throw request_error("--axes", arguments.axes, "is done by one process",
                        "rondo axes DIRECTORY, after the sweep and without mpirun or srun");
  if (arguments.jobs > 0)
    throw InputError(Fault{"--jobs", 0, 0, "", "", "mpirun decides how many runs go on at once",
                           "leave --jobs out"});
  catch_stop_signals();
  const std::unique_ptr<study::Team> team = make_mpi_team(stop_requested());
  if (!team->leads()) {  // all have the same message
    spdlog::set_level(spdlog::level::off);
    tell.json = false;
  }
  return run_ranks(arguments, *team, tell);
}

}  // namespace rondo::app
