// SPDX-License-Identifier: BSD-3-Clause
/// @file  The tables of a sweep: results.csv, sweep.h5, timings.csv (docs/studies.md).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/study/sweep/sweep_members.hpp"

namespace rondo::study {

enum class MemberStatus { waiting, done, failed, interrupted };

[[nodiscard]] const char* name_of(MemberStatus status) noexcept;

/// The result of a member.
struct MemberRow {
  MemberStatus status = MemberStatus::waiting;
  int code = 0;                 ///< exit code of a failed run
  std::string message;          ///< message of a failed run
  bool kept = false;            ///< it existed already
  long long steps = 0;          ///< done
  double end_time = 0.0;        ///< reached [s]; 0: no motion
  std::vector<double> figures;  ///< in the order of the plan's figures; empty: none
  int worker = 0;
  double wall_s = 0.0;  ///< of the run that made it
};

/// Whether it has neither finished nor failed.
[[nodiscard]] inline bool is_unfinished(const MemberRow& row) noexcept {
  return row.status == MemberStatus::interrupted || row.status == MemberStatus::waiting;
}

[[nodiscard]] std::string packed(const MemberRow& row);
/// @pre `text` was made by packed()
[[nodiscard]] MemberRow unpacked(const std::string& text);

struct SweepTables {
  const SweepStudy& study;
  const PlannedSweep& plan;
  const std::vector<MemberRow>& rows;  ///< (members)
};

/// results.csv and sweep.h5, which depend only on study and program; timings.csv.
/// @throws FileError
void write_tables(const std::filesystem::path& directory, const SweepTables& tables);

}  // namespace rondo::study
