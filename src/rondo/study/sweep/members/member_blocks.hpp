// SPDX-License-Identifier: BSD-3-Clause
/// @file  Processes many members in blocks, if one takes less time than handing it to a worker.
#pragma once
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>

#include "rondo/study/sweep/sweep_team.hpp"

namespace rondo::study {

struct MemberWork {
  std::size_t count = 0;                                    ///< number of members
  std::function<nlohmann::json(std::size_t k)> work;        ///< done by workers, ascending
  std::function<void(std::size_t k, nlohmann::json)> take;  ///< called here with each result
  /// If the team leads: called from time to time with the number of members done; may be empty.
  std::function<void(std::size_t done)> watch;
};

/// All members of the team call it. Returns false if a stop was requested; nothing is taken then.
/// @throws the exception that made a block of work fail
[[nodiscard]] bool each_member(const MemberWork& members, Team& team);

}  // namespace rondo::study
