// SPDX-License-Identifier: BSD-3-Clause
/// @file  What this program was built from, for users who want to reproduce its numbers: commit of
/// the sources, compiler and flags, versions of the libraries. The exact program is identified by
/// build_id().
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rondo {

struct BuildRecord {
  std::string commit;            ///< of the sources, hexadecimal; "unknown" without git
  std::optional<bool> modified;  ///< the files differed from the commit; none: unknown
  std::string compiler;          ///< name, version, build type; sanitizers
  std::string flags;             ///< common to all modules; each adds its warnings
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version that it was
                                                               ///< built with
};

/// Written at each build (cmake/commit.cmake) of programs and the Python module; -1: unknown.
extern const char* const built_commit;
extern const int built_modified;

/// Sets the commit that build_record() reports. Must be called before anything else.
/// @param modified 1, 0, or -1: unknown
void set_commit(std::string commit, int modified);

/// The record of this build. Without set_commit() the commit is unknown.
[[nodiscard]] BuildRecord build_record();

/// The record as lines of text, each with a line feed: commit, compiler and flags, libraries.
[[nodiscard]] std::string in_lines(const BuildRecord& record);

}  // namespace rondo
