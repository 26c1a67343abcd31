// SPDX-License-Identifier: BSD-3-Clause
/// @file  One member of a sweep: it is run, resumed, or found to exist already.
#pragma once
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/build/build.hpp"
#include "rondo/study/sweep/sweep_members.hpp"
#include "rondo/study/sweep/sweep_results.hpp"

namespace rondo::study {

/// The data with which all members are run; a worker keeps the body from one member to the next.
struct MemberRunner {
  const SweepStudy& study;
  const PlannedSweep& plan;
  const std::filesystem::path& directory;  ///< of the sweep
  std::filesystem::path lent_directory;    ///< with runs/ of members run for other shards
  const std::vector<MemberRow>& rows;      ///< (members) of earlier phases: see phases_of()
  std::function<void()> tick;              ///< called from time to time during a run; may be empty
  SharedBody shared;
};

/// Runs or finds the member and returns its row. @throws InputError, FileError, as a run
[[nodiscard]] MemberRow run_member(MemberRunner& runner, std::size_t member,
                                   const std::atomic<bool>& stop);

/// A file of a finished member that no longer exists; empty: there is none.
[[nodiscard]] std::string missing_file(const std::filesystem::path& sweep, std::size_t member,
                                       std::size_t n);

/// The row of a member that exists already; none: it must be run. @pre !plan.direct
/// @throws InputError, FileError
[[nodiscard]] std::optional<MemberRow> kept_row(const MemberRunner& runner, std::size_t member);

}  // namespace rondo::study
