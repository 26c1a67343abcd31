// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the study of the paper computes: the runs and decompositions behind its figures 2 to
/// 6 (docs/paper.md).
#pragma once
#include <string>
#include <vector>

#include "rondo/study/case.hpp"

namespace rondo::study {

struct PaperRun {
  std::string name;                   ///< its directory is runs/<name>
  std::string case_name;              ///< "ledge-smooth" of cases/ledge-smooth.toml
  std::vector<std::string> settings;  ///< "a.b=value" on top of it
  bool may_fail = false;              ///< the scheme as printed, which blows up: that is the point
};

struct PaperPod {
  std::string run, field, frame;  ///< its directory is runs/<run>/pod/<field>-<frame>
};

/// Modes kept of each decomposition; its spectrum is stored whole.
inline constexpr int paper_modes = 12;

struct PaperPlan {
  std::vector<PaperRun> runs;
  std::vector<PaperPod> pods;
};

/// @param quick coarse meshes and fewer snapshots: seconds instead of half a minute
[[nodiscard]] PaperPlan paper_plan(bool quick);

/// The shipped case with the run's settings.
[[nodiscard]] Case case_of(const PaperRun& run);

/// The command that gives the same, from the root of the project.
[[nodiscard]] std::string command_of(const PaperRun& run);
[[nodiscard]] std::string command_of(const PaperPod& pod);

}  // namespace rondo::study
