// SPDX-License-Identifier: BSD-3-Clause
/// @file  What this program was built from, for whoever wants the same numbers again: the commit of
/// the sources, compiler and flags, versions of the libraries. What tells programs apart to the bit
/// is build_id().
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rondo {

struct BuildRecord {
  std::string commit;            ///< of the sources, in hexadecimal; "unknown" without git
  std::optional<bool> modified;  ///< files differed from the commit; none: unknown
  std::string compiler;          ///< name, version, kind of build; sanitizers
  std::string flags;             ///< of every module; each adds its warnings
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version that it was built
                                                               ///< with
};

/// Written by each build (cmake/commit.cmake), of programs and the module of Python; -1: unknown.
extern const char* const built_commit;
extern const int built_modified;

/// What build_record() says of the sources from now on. To be called first of all.
/// @param modified 1, 0, or -1: unknown
void set_commit(std::string commit, int modified);

/// Without set_commit() the commit is unknown.
[[nodiscard]] BuildRecord build_record();

/// In lines of text, each with a line feed: commit, compiler and flags, libraries.
[[nodiscard]] std::string in_lines(const BuildRecord& record);

}  // namespace rondo
