// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_directory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

#include "rondo/core/error.hpp"
#include "rondo/io/axes_tables.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/hash.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/kept_runs.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

constexpr std::array files_written{"results.csv", "sweep.h5", "timings.csv"};

/// Reads sweep.json if this program knows its format. @throws InputError, FileError
Json read_sweep(const fs::path& directory) {
  Json found;
  try {
    found = io::read_json(directory / "sweep.json");
  } catch (const FileError& error) {
    std::error_code none;
    throw FileError(error, fs::exists(directory / shards_folder, none)
                               ? "remove it, and collect the shards again"
                               : "give --overwrite to make the sweep anew, or choose another -o");
  }
  if (text_in(found, "format") != sweep_format)
    io::refuse_directory(directory,
                         fmt::format("holds a sweep of format \"{}\", not \"{}\"",
                                     text_in(found, "format"), sweep_format),
                         "choose another -o");
  return found;
}

/// Refuses if shards are running there, which would lose their runs. @throws FileError
void demand_no_shard_at_work(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory / shards_folder, error))
    if (entry.is_directory(error)) static_cast<void>(io::DirectoryLock(entry.path()));
}

/// Checks, as far as files show, that no process, here or elsewhere, uses what is to be removed.
/// @throws FileError
void demand_ended(const fs::path& directory) {
  const std::string host = io::holder_of(directory).host;
  if (host.empty()) return;
  static_cast<void>(io::DirectoryLock(directory));
  if (host != io::host_name())
    throw FileError(directory.string(),
                    fmt::format("was begun on {}, and its files do not say that it has ended "
                                "there: it is not removed; make sure that it has ended, and "
                                "remove it by hand or choose another -o",
                                host));
}

/// Checks the sweep and all its shards and runs. @throws FileError
void demand_all_ended(const fs::path& sweep) {
  demand_ended(sweep);
  std::error_code error;
  for (const char* folder : {shards_folder, "runs"})
    for (const auto& entry : fs::directory_iterator(sweep / folder, error))
      demand_ended(entry.path());
}

/// Handles an existing sweep.json. A damaged one does not prevent a sweep from starting again.
/// @throws InputError, FileError
void accept(const SweepRequest& request, const std::string& hash) {
  try {
    static_cast<void>(read_sweep(request.directory));
  } catch (const FileError&) {
    if (!request.overwrite) throw;
  }
  if (request.overwrite) return demand_all_ended(request.directory);
  if (!request.resume)
    io::refuse_directory(request.directory, "holds a sweep",
                         "give --resume to continue it or --overwrite to begin anew, or choose "
                         "another -o");
  demand_same_sweep(request.directory, hash, ", or give --overwrite to begin anew");
}

}  // namespace

fs::path run_directory(const fs::path& sweep, std::size_t member, std::size_t n) {
  const std::size_t digits = std::max<std::size_t>(4, fmt::formatted_size("{}", n));
  return sweep / "runs" / fmt::format("{:0{}}", member + 1, digits);
}

std::string hash_of(const SweepStudy& study, const PlannedSweep& plan) {
  io::Hash hash;
  const auto time = [](const std::optional<double>& t) {
    return t ? fmt::format("{}", *t) : std::string("-");
  };
  const std::string window = time(study.window.from) + " " + time(study.window.to);
  hash.add(std::span<const char>(window));
  for (const std::string& column : study.columns) hash.add(std::span<const char>(column));
  for (const PlannedMember& member : plan.members) hash.add(std::span<const char>(member.hash));
  return hash.text();
}

void demand_same_sweep(const fs::path& directory, const std::string& hash,
                       const std::string& otherwise) {
  const Json found = read_sweep(directory);
  if (text_in(found, "members_hash") != hash)
    io::refuse_directory(directory,
                         "holds another sweep: study, base case, mesh or --set have changed since",
                         "choose another -o" + otherwise);
  if (!is_of_this_program(found))
    io::refuse_directory(directory,
                         fmt::format("holds a sweep of another build of rondo ({}, build id {}), "
                                     "whose runs this one would all make again",
                                     text_in(found, "version"), text_in(found, "build_id")),
                         "go on with that program, choose another -o" + otherwise);
}

void refuse_foreign_files(const fs::path& directory, bool runs) {
  std::error_code error;
  for (const char* name :
       {"run.json", "runs", files_written[0], files_written[1], files_written[2]})
    if ((runs || std::string_view(name) != "runs") && fs::exists(directory / name, error))
      io::refuse_directory(directory, fmt::format("holds {}, and no sweep", name),
                           "choose another -o");
}

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw FileError(directory.string(),
                    "cannot create directory: " + error.message() + "; choose another -o");
}

void prepare_sweep(const SweepRequest& request, const std::string& hash) {
  const fs::path& directory = request.directory;
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    io::refuse_directory(directory, "is there and is not a directory", "choose another -o");
  demand_no_shard_at_work(directory);
  if (fs::exists(directory / "sweep.json", error)) return accept(request, hash);
  if (fs::exists(directory / shards_folder, error))
    io::refuse_directory(directory, "holds shards of a sweep that are not collected",
                         "rondo sweep STUDY --collect, or choose another -o");
  refuse_foreign_files(directory, true);
  make_directory(directory);
}

void clear_sweep(const SweepRequest& request) {
  if (!request.overwrite) return;
  io::remove_axes_tables(request.directory, "results");
  std::error_code error;
  for (const char* name :
       {"runs", "pod", shards_folder, files_written[0], files_written[1], files_written[2]})
    fs::remove_all(request.directory / name, error);
}

void demand_room(const SweepRequest& request, const PlannedSweep& plan) {
  std::size_t bytes = 0;
  std::error_code error;
  const bool none = !fs::exists(request.directory / "runs", error);
  for (std::size_t m = 0; m < plan.members.size(); ++m)
    if (none || !fs::exists(run_directory(request.directory, m, plan.members.size()), error))
      bytes += plan.members[m].disk_bytes;
  io::demand_room(request.directory / "sweep.h5", bytes);
}

std::vector<fs::path> runs_of_sweep(const fs::path& directory) {
  std::vector<fs::path> runs;
  std::error_code error;
  if (!fs::exists(directory / "sweep.json", error)) return runs;
  const Json sweep = io::read_json(directory / "sweep.json");
  const auto n = static_cast<std::size_t>(std::max(0.0, number_in(sweep, "members")));
  for (std::size_t m = 0; m < n; ++m) {
    const fs::path run = run_directory(directory, m, n);
    if (!fs::exists(run / "run.json", error)) continue;
    if (text_in(io::read_json(run / "run.json"), "status") == "done") runs.push_back(run);
  }
  return runs;
}

}  // namespace rondo::study
