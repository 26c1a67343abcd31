// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/io/axes_tables.hpp"
#include "rondo/io/files.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

/// If any of these exists, the directory contains a run.
constexpr std::array run_marks = {"run.json", "results.h5", "history.csv", "modes.json",
                                  "modes.h5"};
/// Files of a run or of modes in the order in which they are removed: after an interruption, the
/// rest is still recognised as a run, and no checkpoint remains without its files.
constexpr std::array output_files = {
    "checkpoint.h5",     "checkpoint.h5.new",   "results.h5.new", "history.csv", "contact.csv",
    "convergence.csv",   "slip-step.csv",       "cords.csv",      "fields.xdmf", "fields.vtkhdf",
    "fields.vtkhdf.new", "results.h5",          "modes.h5",       "modes.xdmf",  "modes.csv",
    "campbell.csv",      "critical-speeds.csv", "modes.json"};
constexpr std::array input_files = {"mesh.msh", "case.toml"};
constexpr std::array pod_files = {
    "pod.json", "pod.h5", "spectrum.csv", "modes.xdmf", "reconstruction.xdmf", "basis.h5"};

std::string message(int code) {
  return std::generic_category().message(code);
}

/// Whether something has that name, even a link to nowhere.
bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

void remove_one(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw FileError(file.string(), "cannot remove: " + message(error.value()));
}

/// Removes PODs of a removed run: their files in the run's own pod/, and folders that become
/// empty.
void remove_pods(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory / "pod", error)) {
    remove_left_unfinished(entry.path());
    for (const char* name : pod_files) remove_one(entry.path() / name);
    if (fs::is_empty(entry.path(), error)) remove_one(entry.path());
  }
  if (fs::is_empty(directory / "pod", error)) remove_one(directory / "pod");
}

/// Removes NAME.PROCESS.tmp of a program that was killed before it could rename the file.
void remove_unfinished(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    const std::string name = entry.path().filename().string();
    const auto begins = [&](const char* file) { return name.starts_with(std::string(file) + "."); };
    if (name.ends_with(".tmp") &&
        (begins("run.json") || std::any_of(input_files.begin(), input_files.end(), begins) ||
         std::any_of(output_files.begin(), output_files.end(), begins)))
      remove_one(entry.path());
  }
}

/// Removes contact problems of a removed run.
void remove_contact_problems(const fs::path& directory) {
  const fs::path folder = directory / "contact-problems";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") remove_one(entry.path());
  if (fs::is_empty(folder, error)) remove_one(folder);
}

/// Files that say whether a run, a sweep or a shard is at work in the directory.
constexpr std::array state_files = {"run.json", "sweep.json", "rows.json"};

Holder holder_by(const fs::path& file) {
  try {
    const auto json = read_json(file);
    if (json.value("status", "") != "running") return {};
    return {json.value("process", 0), json.value("host", "")};
  } catch (const std::exception&) {  // no such file, or not ours
    return {};
  }
}

[[noreturn]] void refuse_held(const fs::path& directory, const Holder& holder) {
  const std::string who =
      holder.process > 0 ? fmt::format(" (process {} on {})", holder.process, holder.host) : "";
  throw FileError(directory.string(),
                  fmt::format("another rondo is at work here{}; wait until it ends", who));
}

bool is_without_locks(int code) {
  return code == ENOSYS || code == EOPNOTSUPP || code == ENOLCK || code == EINVAL;
}

/// Whether the process has ended but its parent has not yet waited for it.
bool is_zombie(int process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string stat;
  std::getline(file, stat);  // "PID (NAME) STATE ..."
  const auto name_end = stat.rfind(") ");
  return name_end != std::string::npos && (stat[name_end + 2] == 'Z' || stat[name_end + 2] == 'X');
}

/// The processes of another host are unknown; they are assumed to have ended.
bool lives(const Holder& holder) {
  return holder.process > 0 && holder.host == host_name() &&
         (::kill(holder.process, 0) == 0 || errno == EPERM) && !is_zombie(holder.process);
}

}  // namespace

void refuse_directory(const fs::path& directory, const std::string& what,
                      const std::string& to_do) {
  throw request_error("-o", directory.string(), what, to_do);
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

Holder holder_of(const fs::path& directory) {
  for (const char* name : state_files) {
    std::error_code error;
    if (!fs::exists(directory / name, error)) continue;
    if (Holder holder = holder_by(directory / name); !holder.host.empty()) return holder;
  }
  return {};
}

DirectoryLock::DirectoryLock(const fs::path& directory)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail_on(directory, "open the directory");
  int code = 0;
  for (int tries = 0; tries < 20; ++tries) {  // a second: children of a killed one may be ending
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    code = errno;
    if (is_without_locks(code) && !lives(holder_of(directory))) return;
    if (code != EWOULDBLOCK && code != EINTR && !is_without_locks(code)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const Holder holder = holder_of(directory);
  ::close(descriptor_);
  if (code == EWOULDBLOCK || is_without_locks(code)) refuse_held(directory, holder);
  throw FileError(directory.string(), "cannot lock: " + message(code));
}

DirectoryLock::DirectoryLock(DirectoryLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void clear_results_directory(const fs::path& directory) {
  for (const char* name : output_files) remove_one(directory / name);
  remove_pods(directory);
  remove_contact_problems(directory);
}

std::string mark_of_run(const fs::path& directory) {
  const auto found = std::find_if(run_marks.begin(), run_marks.end(),
                                  [&](const char* name) { return is_there(directory / name); });
  return found != run_marks.end() ? *found : "";
}

bool is_cut_off(const fs::path& directory) {
  try {
    const std::string status = read_json(directory / "run.json").value("status", "");
    return status == "running" || status == "failed";
  } catch (const std::exception&) {  // no run.json, or not ours
    return false;
  }
}

DirectoryLock take_results_directory(const fs::path& directory, DirectoryUse use) {
  const std::string elsewhere = "choose another -o";
  std::error_code error;
  if (is_there(directory) && !fs::is_directory(directory, error))
    refuse_directory(directory, "is there and is not a directory", elsewhere);
  fs::create_directories(directory, error);
  if (error)
    throw FileError(directory.string(), "cannot create directory: " + message(error.value()));
  DirectoryLock lock(directory);
  remove_unfinished(directory);
  if (use != DirectoryUse::begin) remove_axes_tables(directory, "history");
  if (use == DirectoryUse::overwrite) {
    clear_results_directory(directory);
    for (const char* name : input_files) remove_one(directory / name);
    remove_one(directory / "run.json");
  }
  if (use != DirectoryUse::begin) return lock;
  const std::string go_on =
      is_there(directory / "checkpoint.h5") ? ", --resume to continue it" : "";
  if (const std::string mark = mark_of_run(directory); !mark.empty())
    refuse_directory(directory, fmt::format("holds another run ({} is there)", mark),
                     fmt::format("{}{}, or give --overwrite", elsewhere, go_on));
  return lock;
}

}  // namespace rondo::io
