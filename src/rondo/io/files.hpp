// SPDX-License-Identifier: BSD-3-Clause
/// @file  Small files, written whole or not at all.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "rondo/core/files/removed_at_signal.hpp"

namespace rondo::io {

/// Of a call of the system that has just failed, by errno. @throws FileError: cannot `doing`
[[noreturn]] void fail_on(const std::filesystem::path& file, const char* doing);

/// Empty where it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// Written beside, then renamed: readers never see half a file. @throws FileError
void write_file(const std::filesystem::path& file, const std::string& text);
/// The same but for what a power cut does to it, as file.new: for files that are written often.
void write_beside(const std::filesystem::path& file, const std::string& text);
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);
/// @throws FileError: cannot be read, is not JSON
nlohmann::ordered_json read_json(const std::filesystem::path& file);
/// The file takes the place of `target` in the same file system, at once and for good.
/// @throws FileError
void replace_file(const std::filesystem::path& file, const std::filesystem::path& target);
/// A file being written under a name of its own: removed at the end of its life, and where a signal
/// ends the program at once, unless it was renamed by then.
struct UnfinishedFile {
  std::filesystem::path path;
  RemovedAtSignal at_signal;

  explicit UnfinishedFile(std::filesystem::path file) : path(std::move(file)), at_signal(path) {}
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
};
/// What the names of this process's unfinished files end with: ".HOST.PROCESS.tmp".
std::string unfinished_ending();
/// Removes files and folders with such names that processes of this machine have left which are no
/// more: they were killed, or the machine went down.
void remove_left_unfinished(const std::filesystem::path& directory);
/// What the file holds is on the disk, whatever happens to the machine. @throws FileError
void sync_file(const std::filesystem::path& file);
/// Better before the work than after it: a file of that many bytes would fill the disk. File
/// systems that do not say are believed to have room. @throws FileError
void demand_room(const std::filesystem::path& file, std::size_t bytes);
/// For a full disk: over the old text of a small file, in place, which asks for no new room.
/// False where that cannot be done either.
bool overwrite_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) noexcept;

}  // namespace rondo::io
