// SPDX-License-Identifier: BSD-3-Clause
/// @file  The results of the members of a sweep or of one shard: counted, reported, written.
#pragma once
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/member_run.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::study {

class SweepRows {
 public:
  /// All arguments are kept by reference. Reads the case of run 1, which sweep.json tells, before
  /// its file may change. @throws InputError, FileError
  SweepRows(const SweepRequest& request, const SweepStudy& study, const PlannedSweep& plan);

  /// Writes sweep.json. @throws FileError
  void write(const char* status) const;
  /// @throws FileError
  void write_tables() const { study::write_tables(request_.directory, {study_, plan_, rows_}); }

  /// @param members numbers of the members to which the pieces belong
  void take(const std::vector<std::size_t>& members, const std::vector<Piece>& pieces);
  void take(std::size_t member, MemberRow row) { rows_[member] = std::move(row); }
  /// Call after the runs: takes the rows of finished members that were not reached. Finished
  /// members whose files are missing count as failed. @throws InputError, FileError
  void compare_with_files(const MemberRunner& runner);
  /// For a sweep that others ran; else the time since this object was created is used.
  void set_wall(double seconds) { wall_s_ = seconds; }

  [[nodiscard]] const std::vector<MemberRow>& rows() const noexcept { return rows_; }
  /// Whether one of these members is unfinished.
  [[nodiscard]] bool is_unfinished(const std::vector<std::size_t>& members) const;
  /// Report of the members that are its own.
  [[nodiscard]] SweepReport report() const;

 private:
  [[nodiscard]] bool is_own(std::size_t m) const { return plan_.members[m].part == Part::own; }
  [[nodiscard]] std::string place_of(std::size_t m) const;
  void add_failure(std::size_t m, SweepReport& r) const;
  void add_strains(SweepReport& r) const;
  [[nodiscard]] Json describe_parameters() const;
  [[nodiscard]] Json describe(std::string_view status) const;

  using Clock = std::chrono::steady_clock;
  const SweepRequest& request_;
  const SweepStudy& study_;
  const PlannedSweep& plan_;
  const std::string first_case_;
  std::vector<MemberRow> rows_;
  Clock::time_point begin_ = Clock::now();
  std::optional<double> wall_s_;
};

/// "done", "failed" (some members did) or "interrupted".
[[nodiscard]] const char* status_of(const SweepReport& report) noexcept;

/// The study file with the settings of the request. @throws InputError, FileError
[[nodiscard]] SweepStudy study_of(const SweepRequest& request);

/// Warns that the sweep to be resumed may still be running on another machine.
void warn_of_another_host(const SweepRequest& request, const std::filesystem::path& directory);

/// Gives each warning once, with the number of members that it concerns.
void warn_of_members(const SweepRequest& request, const PlannedSweep& plan);

/// The leader's part before the runs; if it fails, all fail. All members of the team call it.
/// @throws what `part` throws; std::runtime_error: the leader has failed
void lead(Team& team, const std::function<void()>& part);

/// Runs phase by phase, up to one that is not finished. All members of the team call it.
void run_members(const SweepRequest& request, MemberRunner& runner, Team& team, SweepRows& rows);

/// The report if a stop was requested before all was checked.
[[nodiscard]] SweepReport interrupted_report(const PlannedSweep& plan);

}  // namespace rondo::study
