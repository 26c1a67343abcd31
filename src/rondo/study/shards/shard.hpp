// SPDX-License-Identifier: BSD-3-Clause
/// @file  A part of a sweep that a job of its own makes: which one, and which members are in it.
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

/// "3/8". @throws InputError: says what is allowed
[[nodiscard]] Shard shard_of(const std::string& text);

/// "3/8".
[[nodiscard]] std::string text_of(const Shard& shard);
/// "0003-of-0008".
[[nodiscard]] std::string folder_name(const Shard& shard);
/// False: the name is of no shard's folder.
[[nodiscard]] bool shard_of_folder(const std::string& name, Shard& shard);

/// The shard of each member (members), from 1: equal in number but for one; members that share a
/// body are together, where this does not stop it, and bodies are dealt out, so that those that
/// take long are not all in one shard. Hangs on the study alone. @pre members have been read
[[nodiscard]] std::vector<std::size_t> divide(const std::vector<PlannedMember>& members,
                                              std::size_t shards);

/// Members of the shard are own; first ones of other shards with whose modes some of these begin
/// are lent; all else is other.
void choose_members(std::vector<PlannedMember>& members, const Shard& shard);

}  // namespace rondo::study
