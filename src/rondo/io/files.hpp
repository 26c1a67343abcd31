// SPDX-License-Identifier: BSD-3-Clause
/// @file  Results directories and small files.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace rondo::io {

/// @throws InputError: -o names a directory that cannot be used, `what` is wrong with it, `to_do`
[[noreturn]] void refuse_directory(const std::filesystem::path& directory, const std::string& what,
                                   const std::string& to_do);

/// Makes `directory` ready for a run: creates it with its parents, refuses one that holds another
/// run (run.json, results.h5, history.csv) or modes (modes.json, modes.h5) unless `overwrite`,
/// which removes those files and the PODs in its own pod/ (and nothing else). @throws InputError
/// (holds a run; is not a directory), FileError (cannot create).
void prepare_results_directory(const std::filesystem::path& directory, bool overwrite);

/// Written beside, then renamed: readers never see half a file. @throws FileError
void write_file(const std::filesystem::path& file, const std::string& text);
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);
/// @throws FileError: cannot be read, is not JSON
nlohmann::ordered_json read_json(const std::filesystem::path& file);
/// The file takes the place of `target` in the same file system, at once and for good.
/// @throws FileError
void replace_file(const std::filesystem::path& file, const std::filesystem::path& target);
/// Better before the work than after it: a file of that many bytes would fill the disk. File
/// systems that do not say are believed to have room. @throws FileError
void demand_room(const std::filesystem::path& file, std::size_t bytes);
/// For a full disk: over the old text of a small file, in place, which asks for no new room.
/// False where that cannot be done either.
bool overwrite_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) noexcept;

/// Held by one program at a time, until it and the processes that it forked have ended, however
/// they end.
class DirectoryLock {
 public:
  /// @throws FileError: another program holds it, still after a second; cannot be made
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace rondo::io
