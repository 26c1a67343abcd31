// SPDX-License-Identifier: BSD-3-Clause
/// @file  The heights and depths of members whose study gives loads.
#pragma once
#include "rondo/study/sweep/member_faults.hpp"
#include "rondo/study/sweep/sweep_members.hpp"
#include "rondo/study/sweep/sweep_team.hpp"

namespace rondo::study {

/// Place of the parameter with a target; as many as parameters: there is none.
[[nodiscard]] std::size_t target_of(const SweepStudy& study);

/// Solves the targets of all members, each crush once, and adds what is found to their settings.
/// False: a stop was asked for. @throws InputError: two targets
[[nodiscard]] bool find_targets(const MembersRequest& request, Team& team,
                                std::vector<PlannedMember>& members, MemberFaults& faults);

}  // namespace rondo::study
