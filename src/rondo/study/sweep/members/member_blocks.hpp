// SPDX-License-Identifier: BSD-3-Clause
/// @file  Work on each of many members that takes less time than handing it to a worker: in blocks.
#pragma once
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>

#include "rondo/study/sweep/sweep_team.hpp"

namespace rondo::study {

struct MemberWork {
  std::size_t count = 0;                                    ///< of members
  std::function<nlohmann::json(std::size_t k)> work;        ///< by the workers, in ascending order
  std::function<void(std::size_t k, nlohmann::json)> take;  ///< what each gave, in this process
  /// Called now and then where the team leads with the number of members done; may be empty.
  std::function<void(std::size_t done)> watch;
};

/// All members of the team call it. False: a stop was asked for, and nothing more is taken.
/// @throws what made a block of work fail
[[nodiscard]] bool each_member(const MemberWork& members, Team& team);

}  // namespace rondo::study
