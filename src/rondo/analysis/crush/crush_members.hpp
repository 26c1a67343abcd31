// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a crush has in run.json, in the plane and of a wheel in three dimensions.
#pragma once
#include <string>
#include <vector>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/crush/crush_path.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/statics/crush.hpp"

namespace rondo::study {

/// The path that is planned. @param prepare_s wall time before the first increment [s]
void describe_path(const AnalysisCase& analysis, const CrushPath& path, double prepare_s,
                   Json& json);
/// "8 increments to a depth of 0.02 m and a slide of 0.001 m"
[[nodiscard]] std::string reached_text(int increments, double depth, double slide);

/// A crush has nothing to resume from. @throws InputError: it is asked for
void refuse_resume(const Case& c, const RunOptions& options);

/// What is largest of all increments.
struct CrushLargest {
  double residual = 0.0;     ///< of the law
  double equilibrium = 0.0;  ///< residual
  double penetration = 0.0;  ///< [m]

  void take(double residual, double equilibrium, double penetration);
};
/// Where a crush has come.
struct CrushEnd {
  int increments = 0;  ///< done, whose results are kept
  double depth = 0.0, slide = 0.0;
  const statics::CrushWorks& works;
};
/// Adds what run.json has of it, and what the user is told.
void summarise_crush(const CrushEnd& end, const CrushLargest& largest, const CrushPath& path,
                     const StrainWatch& strain, Json& json, RunReport& report);

/// What was done for the increments of a wheel, and where it is at the end.
struct WheelEffort {
  double height = 0.0;            ///< of the center above y = 0                              [m]
  double depth = 0.0;             ///< of the center below first touch                        [m]
  int newton_steps = 0;           ///< most of an increment
  std::size_t pairs = 0;          ///< contact nodes that were considered
  bool is_nonlinear = false;      ///< the next two have a meaning
  double balance_residual = 0.0;  ///< largest
  int contact_problems = 0;       ///< of all increments
};
void add_wheel_effort(const WheelEffort& effort, Json& json);

std::vector<MemberText> crush_path_members();

}  // namespace rondo::study
