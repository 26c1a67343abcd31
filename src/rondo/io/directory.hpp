// SPDX-License-Identifier: BSD-3-Clause
/// @file  Results directories: which program may use one, and what it contains.
#pragma once
#include <filesystem>
#include <string>

namespace rondo::io {

/// Name of this machine.
std::string host_name();

/// @throws InputError: -o names a directory that cannot be used; `what` is wrong, `to_do` about it
[[noreturn]] void refuse_directory(const std::filesystem::path& directory, const std::string& what,
                                   const std::string& to_do);

/// A process that uses a directory.
struct Holder {
  int process = 0;
  std::string host;  ///< empty: no file names such a process
};

/// Reads run.json, sweep.json or rows.json with the status "running"; it does not check whether the
/// process is still alive.
Holder holder_of(const std::filesystem::path& directory);

/// Lets one program at a time use a directory, until it and the processes that it forked have ended
/// in any way.
class DirectoryLock {
 public:
  /// On a file system without locks, it looks for the process of holder_of() instead.
  /// @throws FileError: another program still holds it after a second; cannot be created
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&&) = delete;

 private:
  int descriptor_ = -1;
};

enum class DirectoryUse {
  begin,      ///< refused if there is another run (run.json, results.h5, history.csv) or modes
  overwrite,  ///< removes its files and the PODs in its own pod/ (and nothing else)
  go_on,      ///< continues with the existing files
};

/// Creates `directory` with its parents and locks it for a run. @throws InputError (contains a run;
/// is not a directory), FileError (cannot be created; another program uses it).
[[nodiscard]] DirectoryLock take_results_directory(const std::filesystem::path& directory,
                                                   DirectoryUse use);

/// A file that shows that there is a run or modes; empty: there is none.
std::string mark_of_run(const std::filesystem::path& directory);

/// Whether by its run.json the run did not finish: it failed or was killed. (While this program
/// holds the directory, a run that is "running" no longer exists.)
bool is_cut_off(const std::filesystem::path& directory);

/// Removes all files of a run except its inputs (case.toml, mesh.msh) and run.json, which are
/// replaced when a run begins. @pre the directory is locked. @throws FileError
void clear_results_directory(const std::filesystem::path& directory);

}  // namespace rondo::io
