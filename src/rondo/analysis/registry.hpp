// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which analyses there are: a row each, or several where figures depend on the case.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/figures/figures.hpp"

namespace rondo::study {

struct AnalysisType {
  AnalysisKind kind;
  bool (*is_of)(const Case& c);  ///< the cases of this kind that the row is for; null: all others
  const char* unit;              ///< what is counted: "step"
  /// @throws InputError: the case cannot run so
  std::unique_ptr<Analysis> (*make)(const Case& c, const RunOptions& options);
  FigureTable figures;  ///< figures of a row of a sweep's results.csv
  /// The figures without a directory, for members of a sweep that keep no snapshots: where writing
  /// it takes longer than the run. Null: its runs have directories. @throws InputError as a run
  DirectRun (*direct)(const Case& c, const RunOptions& options) = nullptr;
  bool finds_modes = false;  ///< its runs find modes, and may begin with those of another run
  /// Runs with equal keys that follow one another share more than the body. Null: nothing.
  std::string (*shared_key)(const Case& c) = nullptr;
};

[[nodiscard]] const AnalysisType& type_of(const Case& c) noexcept;

/// The analysis of the case, or of its reduced wheel where the options ask for one. Case and
/// options must outlive it. @throws InputError, FileError
[[nodiscard]] std::unique_ptr<Analysis> make_analysis(const Case& c, const RunOptions& options);

struct CheckOptions {
  int threads = 0;                  ///< 0: chosen by size
  double trial_s = 0.2;             ///< time for steps to estimate `seconds`; 0: none, seconds = 0
  SharedBody* shared = nullptr;     ///< shared body, as for build()
  bool columns = false;             ///< those of history.csv are wanted
  const RunOptions* run = nullptr;  ///< a run with these, e.g. `reduced`; null: of the mesh
};

/// The cost of a case and whether it can run, without running it. @throws InputError as a run
/// would
[[nodiscard]] CheckReport check_case(const Case& c, const CheckOptions& options);

}  // namespace rondo::study
