// SPDX-License-Identifier: BSD-3-Clause
/// @file  A part of a sweep that a separate job runs: its number and its members.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/study/sweep/sweep_members.hpp"

namespace rondo::study {

struct Shard {
  std::size_t number = 1;  ///< from 1
  std::size_t count = 1;   ///< of all shards
};

/// Reads "3/8". @throws InputError: says what is allowed
[[nodiscard]] Shard shard_of(const std::string& text);

/// "3/8".
[[nodiscard]] std::string text_of(const Shard& shard);
/// "0003-of-0008".
[[nodiscard]] std::string folder_name(const Shard& shard);
/// Returns false if the name is not that of a shard's folder.
[[nodiscard]] bool shard_of_folder(const std::string& name, Shard& shard);

/// The shard of each member (members), from 1. Shards have equal numbers of members, or one more.
/// Members that share a body are together if possible, and bodies are distributed so that long runs
/// are not all in one shard. The result depends only on the study. @pre members have been read
[[nodiscard]] std::vector<std::size_t> divide(const std::vector<PlannedMember>& members,
                                              std::size_t shards);

/// Members of the shard become own. First members of other shards with whose modes some of these
/// start become lent; all others become other.
void choose_members(std::vector<PlannedMember>& members, const Shard& shard);

}  // namespace rondo::study
