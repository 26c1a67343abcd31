// SPDX-License-Identifier: BSD-3-Clause
/// @file  One member of a sweep: run, gone on with, or found to be there already.
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

/// What all members of a sweep are run by; of a worker, which keeps the body from one to the next.
struct MemberRunner {
  const SweepStudy& study;
  const PlannedSweep& plan;
  const std::filesystem::path& directory;  ///< of the sweep
  std::filesystem::path lent_directory;    ///< with runs/ of members that are lent
  const std::vector<MemberRow>& rows;      ///< (members) of phases before: see phases_of()
  std::function<void()> tick;              ///< called now and then within a run; may be empty
  SharedBody shared;
};

/// The member's row, made or found. @throws InputError, FileError, as a run
[[nodiscard]] MemberRow run_member(MemberRunner& runner, std::size_t member,
                                   const std::atomic<bool>& stop);

/// A file of a member that was done, and is not there any more; empty: there is none.
[[nodiscard]] std::string missing_file(const std::filesystem::path& sweep, std::size_t member,
                                       std::size_t n);

/// The row of a member that is there already; none: it is to be made. @pre !plan.direct
/// @throws InputError, FileError
[[nodiscard]] std::optional<MemberRow> kept_row(const MemberRunner& runner, std::size_t member);

}  // namespace rondo::study
