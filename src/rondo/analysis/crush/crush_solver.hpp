// SPDX-License-Identifier: BSD-3-Clause
/// @file  How the increments of a crush are solved. The analysis around it is one (crush.cpp).
#pragma once
#include <memory>
#include <string>

#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// In this order: prepare, iterate until it says false, take of 1, 2, ... n_increments.
class CrushSolver {
 public:
  CrushSolver() = default;
  CrushSolver(const CrushSolver&) = delete;
  CrushSolver& operator=(const CrushSolver&) = delete;
  virtual ~CrushSolver() = default;

  /// Does what takes long and may refuse the case. @throws InputError
  virtual void prepare() = 0;
  /// One iteration on all increments at once. False: there is nothing left to iterate, and the
  /// increments may be taken. @param trouble gets what is wrong, where the run cannot go on
  [[nodiscard]] virtual bool iterate(std::string& /*trouble*/) { return false; }
  /// From increment k - 1 to k, k >= 1. @param trouble gets what is wrong, with `state` then as it
  /// was or not to be used
  [[nodiscard]] virtual statics::CrushReport take(int k, statics::CrushState& state,
                                                  std::string& trouble) = 0;
  /// Adds to run.json what is its own and known before the first increment.
  virtual void describe(Json& /*json*/) const {}
  /// Adds to run.json, and to the report, what is its own. @param state of the last increment taken
  virtual void summarise(const statics::CrushState& state, Json& json, RunReport& report) const = 0;
};

/// Holds references to all of them. @throws InputError
[[nodiscard]] std::unique_ptr<CrushSolver> make_crush_solver(const Case& c,
                                                             const RunOptions& options,
                                                             const CrushSetup& setup);

/// Work of contact solvers that sweep, over all increments.
class SweepCount {
 public:
  void add(const statics::CrushReport& report) noexcept;
  void summarise(Json& json) const;

 private:
  int sweeps_ = 0;   ///< most of an increment
  int pivoted_ = 0;  ///< increments that the sweeps alone did not solve
};

/// Adds to run.json how many contact nodes the stiffness was condensed on.
void add_condensed(std::size_t candidates, Json& json);

/// Texts of the members that these two add to run.json.
std::vector<MemberText> crush_solver_members();

}  // namespace rondo::study
