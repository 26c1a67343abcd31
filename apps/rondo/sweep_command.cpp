// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

#include "default_directory.hpp"
#include "mpi_team.hpp"
#include "progress.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/error.hpp"
#include "signals.hpp"

namespace rondo::app {
namespace {

/// Fewer members are checked before a bar is seen.
constexpr long long spoken_of = 500;

/// A task of a scheduler that did not start MPI: each would run the whole sweep by itself.
void refuse_tasks_without_mpi() {
  const char* task = std::getenv("SLURM_PROCID");
  if (task != nullptr && std::string_view(task) != "0")
    throw InputError(Fault{"rondo sweep", 0, 0, "", "",
                           fmt::format("is task {} of a job, and MPI was not started", task),
                           "srun --mpi=pmix, or mpirun"});
}

/// Each run with what it would cost.
void print_plan(const study::DrySweep& dry, int workers) {
  double seconds = 0.0, longest = 0.0;
  std::size_t disk = 0;
  for (std::size_t m = 0; m < dry.plan.members.size(); ++m) {
    const study::PlannedMember& member = dry.plan.members[m];
    const std::string time =
        member.seconds > 0.0 ? fmt::format(", about {:.2g} s", member.seconds) : "";
    fmt::print("{}: {} nodes, {} {}{}{}\n", study::name_of(dry.study, member.member, m + 1),
               member.nodes, member.steps, dry.plan.type->unit, member.steps == 1 ? "" : "s", time);
    seconds += member.seconds;
    longest = std::max(longest, member.seconds);
    disk += member.disk_bytes;
  }
  const std::string time = seconds > 0.0
                               ? fmt::format("about {:.3g} s", std::max(longest, seconds / workers))
                               : std::string("the time is not estimated");
  fmt::print("{} runs, {} at once: {}, {} on the disk\n", dry.plan.members.size(), workers, time,
             readable_bytes(disk));
}

int finish(const study::SweepReport& report, const std::filesystem::path& directory) {
  for (const std::string& failure : report.failures) spdlog::warn("{}", failure);
  if (report.failed > report.failures.size())
    spdlog::warn("and {} more: {}", report.failed - report.failures.size(),
                 (directory / "sweep.json").string());
  if (report.strained > 0)
    spdlog::warn(
        "{} of {} runs done {} a largest strain above {:.0f} %, the largest {:.3g} in run {}: the "
        "law of the material is for small strains (strain_max in results.csv)",
        report.strained, report.done, report.strained == 1 ? "has" : "have",
        100.0 * study::small_strain, report.strain_max, report.strain_run);
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

int run(SweepArguments& arguments, study::Team& team, bool quiet) {
  study::SweepRequest& request = arguments.request;
  if (request.directory.empty())
    request.directory = request.resume ? resumed_directory(request.study, "sweep.json")
                                       : default_directory(request.study);
  request.stop = &stop_requested();
  request.warn = [](const std::string& text) { spdlog::warn("{}", text); };
  std::optional<Progress> progress;
  if (!team.leads()) quiet = true;
  request.checking = [&](const char* what, long long done, long long all) {
    if (quiet || all < spoken_of) return;
    if (done == 0 || !progress) progress.emplace(what);
    (*progress)(done, all);
    if (done == all) progress.reset();
  };
  if (arguments.dry_run) {
    const study::DrySweep dry = study::check_sweep(request, team);
    progress.reset();
    if (dry.plan.stopped) return exit_interrupted;
    if (team.leads()) print_plan(dry, team.workers());
    return exit_done;
  }
  request.begin = [&](const study::PlannedSweep& plan, int workers) {
    progress.reset();
    spdlog::info("{} runs, {} at once", plan.members.size(), workers);
    if (!quiet) progress.emplace("run");
  };
  request.progress = [&](long long ended, long long all) {
    if (progress) (*progress)(ended, all);
  };
  const study::SweepReport report = study::run_sweep(request, team);
  progress.reset();
  return team.leads() ? finish(report, request.directory) : exit_done;  // mpirun takes the leader's
}

/// What fails on all ranks alike, the leader alone tells, as of any command. What fails on some
/// ends the others, who wait for them.
int run_ranks(SweepArguments& arguments, study::Team& team, bool quiet) {
  try {
    return run(arguments, team, quiet);
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

int sweep(SweepArguments arguments, bool quiet) {
  if (quiet) spdlog::set_level(spdlog::level::warn);
  catch_stop_signals();
  if (!is_started_by_mpi()) {
    refuse_tasks_without_mpi();
    const int workers = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
    study::LocalTeam team(workers, &stop_requested());
    return run(arguments, team, quiet);
  }
  if (arguments.jobs > 0)
    throw InputError(Fault{"--jobs", 0, 0, "", "", "mpirun decides how many runs go on at once",
                           "leave --jobs out"});
  const std::unique_ptr<study::Team> team = make_mpi_team(stop_requested());
  if (!team->leads()) spdlog::set_level(spdlog::level::off);  // all say the same
  return run_ranks(arguments, *team, quiet);
}

}  // namespace rondo::app
