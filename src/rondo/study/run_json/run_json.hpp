// SPDX-License-Identifier: BSD-3-Clause
/// @file  All members of run.json, from the rows that its writers write it from: for
/// docs/results.md, `rondo schema` and python/rondo/data/members.py.
#pragma once
#include "rondo/case/schema/members.hpp"

namespace rondo::study {

/// Members that go together.
struct MemberGroup {
  std::string_view of;  ///< "all runs", or value of "analysis", or what else has them
  std::vector<MemberText> members;
};

std::vector<MemberGroup> run_json_groups();

/// Schema of run.json at any time after the start of a run.
Json run_json_schema();

/// python/rondo/data/members.py: of each member its unit, that of a wheel in three dimensions, and
/// its meaning.
std::string python_members();

}  // namespace rondo::study
