// SPDX-License-Identifier: BSD-3-Clause
/// @file  Small files, written completely or not at all.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "rondo/core/files/removed_at_signal.hpp"

namespace rondo::io {

/// Reports a system call that has just failed, by errno. @throws FileError: cannot `doing`
[[noreturn]] void fail_on(const std::filesystem::path& file, const char* doing);

/// The contents of a file; empty if it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// Writes a temporary file and renames it, so that readers never see half a file. @throws FileError
void write_file(const std::filesystem::path& file, const std::string& text);
/// Writes by way of file.new, not safe against a power cut: for files written often.
void write_beside(const std::filesystem::path& file, const std::string& text);
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);
/// @throws FileError: cannot be read or is not JSON
nlohmann::ordered_json read_json(const std::filesystem::path& file);
/// Replaces `target` in the same file system by the file, atomically and durably.
/// @throws FileError
void replace_file(const std::filesystem::path& file, const std::filesystem::path& target);
/// A file that is written under a temporary name. It is removed at the end of the object's life, or
/// when a signal ends the program at once, unless it was renamed before.
struct UnfinishedFile {
  std::filesystem::path path;
  RemovedAtSignal at_signal;

  explicit UnfinishedFile(std::filesystem::path file) : path(std::move(file)), at_signal(path) {}
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
};
/// The ending of the names of this process's unfinished files: ".HOST.PROCESS.tmp".
std::string unfinished_ending();
/// Removes files and folders with such names whose processes on this machine no longer exist,
/// because they were killed or the machine went down.
void remove_left_unfinished(const std::filesystem::path& directory);
/// Makes sure that the contents are on the disk even if the machine fails. @throws FileError
void sync_file(const std::filesystem::path& file);
/// Checks before the work whether a file of that many bytes would fill the disk. File systems that
/// do not report their free space are assumed to have room. @throws FileError
void demand_room(const std::filesystem::path& file, std::size_t bytes);
/// Overwrites a small file in place, which needs no new space on a full disk. Returns false if that
/// fails too.
bool overwrite_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) noexcept;

}  // namespace rondo::io
