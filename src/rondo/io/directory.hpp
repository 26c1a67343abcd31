// SPDX-License-Identifier: BSD-3-Clause
/// @file  Results directories: which program may work in one, what it holds.
#pragma once
#include <filesystem>
#include <string>

namespace rondo::io {

/// Of this machine.
std::string host_name();

/// @throws InputError: -o names a directory that cannot be used, `what` is wrong with it, `to_do`
[[noreturn]] void refuse_directory(const std::filesystem::path& directory, const std::string& what,
                                   const std::string& to_do);

/// A process that is at work in a directory.
struct Holder {
  int process = 0;
  std::string host;  ///< empty: no file says that one is at work
};

/// By run.json, sweep.json or rows.json, whose status is then "running"; whether the process is
/// still alive is another matter.
Holder holder_of(const std::filesystem::path& directory);

/// Held by one program at a time, until it and the processes that it forked have ended, however
/// they end.
class DirectoryLock {
 public:
  /// On a file system without locks the process of holder_of() is looked for instead.
  /// @throws FileError: another program holds it, still after a second; cannot be made
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&&) = delete;

 private:
  int descriptor_ = -1;
};

enum class DirectoryUse {
  begin,      ///< refused where there is another run (run.json, results.h5, history.csv) or modes
  overwrite,  ///< whose files and PODs in its own pod/ are removed (and nothing else)
  go_on,      ///< with what is there
};

/// Makes `directory`, with its parents, and takes it for a run. @throws InputError (holds a run; is
/// not a directory), FileError (cannot create; another program is at work there).
[[nodiscard]] DirectoryLock take_results_directory(const std::filesystem::path& directory,
                                                   DirectoryUse use);

/// A file that says that there is a run or modes; empty: none.
std::string mark_of_run(const std::filesystem::path& directory);

/// By its run.json the run there has not come to an end: it was killed (with the directory taken, a
/// run that is "running" is no more), or failed.
bool is_cut_off(const std::filesystem::path& directory);

/// Removes what a run has written, but its inputs (case.toml, mesh.msh) and run.json, which are
/// replaced when it begins anew. @pre the directory is taken. @throws FileError
void clear_results_directory(const std::filesystem::path& directory);

}  // namespace rondo::io
