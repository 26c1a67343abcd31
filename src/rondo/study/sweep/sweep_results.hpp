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

/// What came of a member.
struct MemberRow {
  MemberStatus status = MemberStatus::waiting;
  int code = 0;                 ///< of a failure: exit code of a run that ends so
  std::string message;          ///< of a failure
  bool kept = false;            ///< it was there already
  long long steps = 0;          ///< done
  double end_time = 0.0;        ///< reached [s]; 0: no motion
  std::vector<double> figures;  ///< as the columns of the plan's figures; empty: none
  int worker = 0;
  double wall_s = 0.0;  ///< of the run when it was made
};

/// It has not come to an end, good or bad.
[[nodiscard]] inline bool is_unfinished(const MemberRow& row) noexcept {
  return row.status == MemberStatus::interrupted || row.status == MemberStatus::waiting;
}

[[nodiscard]] std::string packed(const MemberRow& row);
/// @pre made by packed()
[[nodiscard]] MemberRow unpacked(const std::string& text);

struct SweepTables {
  const SweepStudy& study;
  const PlannedSweep& plan;
  const std::vector<MemberRow>& rows;  ///< (members)
};

/// results.csv and sweep.h5, which hang on nothing but study and program; timings.csv.
/// @throws FileError
void write_tables(const std::filesystem::path& directory, const SweepTables& tables);

}  // namespace rondo::study
