// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/sweep_shards.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "documents/documents.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/core/error.hpp"

namespace rondo::app {
namespace {

constexpr std::size_t most_told = 10;

[[noreturn]] void refuse(const char* option, const char* message, const char* allowed) {
  throw request_error(option, "", message, allowed);
}

void demand_collect_alone(const SweepArguments& arguments) {
  const study::SweepRequest& request = arguments.request;
  if (!arguments.shard.empty())
    refuse("--collect", "takes all shards together", "--collect without --shard");
  if (arguments.dry_run || request.resume || request.overwrite)
    refuse("--collect", "makes no runs, and may be given again at any time",
           "--collect without --dry-run, --resume, --overwrite");
}

std::string command(const study::SweepRequest& request, const std::string& what) {
  std::string text = fmt::format("rondo sweep {}", request.study.string());
  for (const std::string& setting : request.settings) text += fmt::format(" --set '{}'", setting);
  return text + fmt::format(" -o {} {}", request.directory.string(), what);
}

/// Ascending numbers as "3,5-8", the format of Slurm's --array.
std::string ranges(const std::vector<study::Shard>& shards) {
  std::string text;
  for (std::size_t k = 0; k < shards.size();) {
    std::size_t last = k;
    while (last + 1 < shards.size() && shards[last + 1].number == shards[last].number + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", shards[k].number);
    if (last > k) text += fmt::format("-{}", shards[last].number);
    k = last + 1;
  }
  return text;
}

/// The progress so far. If a stop was requested, no shard was examined.
std::string state_of(const study::CollectReport& report) {
  if (report.unfinished.empty()) return "interrupted";
  return fmt::format("{} of {} runs done; {} of {} shards not finished: {}", report.done,
                     report.members, report.unfinished.size(), report.shards,
                     ranges(report.unfinished));
}

void warn_of_unfinished(const study::CollectReport& report, const study::SweepRequest& request) {
  for (std::size_t k = 0; k < std::min(most_told, report.unfinished.size()); ++k) {
    const std::string shard = study::text_of(report.unfinished[k]);
    spdlog::warn("shard {} {}: {}", shard, report.states[k],
                 command(request, fmt::format("--shard {} --resume", shard)));
  }
  spdlog::warn("{}; collect again once they are", state_of(report));
}

}  // namespace

std::optional<study::Shard> asked_shard(const SweepArguments& arguments) {
  if (arguments.collect) demand_collect_alone(arguments);
  if (arguments.shard.empty()) return std::nullopt;
  if (arguments.request.overwrite)
    refuse("--shard", "removes nothing that is there: other shards write into the same directory",
           "remove the directory before the shards are made, or choose another -o");
  return study::shard_of(arguments.shard);
}

void warn_of_runs(const study::SweepReport& report, const std::string& more) {
  for (const std::string& failure : report.failures) spdlog::warn("{}", failure);
  if (report.failed > report.failures.size())
    spdlog::warn("and {} more: {}", report.failed - report.failures.size(), more);
  if (report.strained > 0)
    spdlog::warn(
        "{} of {} runs done {} a largest strain above {:.0f} %, the largest {:.3g} in run {}: the "
        "law of the material is for small strains (strain_max in results.csv)",
        report.strained, report.done, report.strained == 1 ? "has" : "have",
        100.0 * study::small_strain, report.strain_max, report.strain_run);
}

void keep_collected(Telling& tell, const study::CollectReport& report,
                    const std::filesystem::path& directory) {
  std::vector<std::size_t> unfinished;
  for (const study::Shard& shard : report.unfinished) unfinished.push_back(shard.number);
  tell.result = sweep_document(report, directory, unfinished);
  if (report.interrupted > 0)
    tell.end = state_of(report);
  else if (report.failed > 0)
    tell.end = fmt::format("{} of {} runs failed", report.failed, report.members);
}

int finish_shard(const study::SweepReport& report, const study::Shard& shard,
                 const study::SweepRequest& request) {
  const std::filesystem::path rows =
      request.directory / "shards" / study::folder_name(shard) / "rows.json";
  warn_of_runs(report, rows.string());
  if (report.interrupted > 0) {
    spdlog::warn("shard {}: interrupted with {} of {} runs done; continue with --resume",
                 study::text_of(shard), report.done, report.members);
    return exit_interrupted;
  }
  if (report.members == 0)
    spdlog::info("shard {}: there are fewer runs than shards, and none is in this one",
                 study::text_of(shard));
  else
    spdlog::info("shard {}: {} of {} runs done{}{} in {:.1f} s", study::text_of(shard), report.done,
                 report.members, report.failed > 0 ? fmt::format(", {} failed", report.failed) : "",
                 report.kept > 0 ? fmt::format(", {} were there already", report.kept) : "",
                 report.wall_s);
  spdlog::info("after all shards: {}", command(request, "--collect"));
  return report.code;
}

int finish_collected(const study::CollectReport& report, const study::SweepRequest& request) {
  warn_of_runs(report, (request.directory / "sweep.json").string());
  if (!report.unfinished.empty()) warn_of_unfinished(report, request);
  if (report.interrupted > 0) return exit_interrupted;
  spdlog::info("{} of {} runs done{}, in {} shards; results.csv and sweep.h5 in {}", report.done,
               report.members, report.failed > 0 ? fmt::format(", {} failed", report.failed) : "",
               report.shards, request.directory.string());
  return report.code;
}

}  // namespace rondo::app
