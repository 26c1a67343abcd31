// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the study of the paper computes: the runs and decompositions behind its figures 2 to
/// 6 (docs/paper.md).
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"

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

/// @param quick coarse meshes and fewer snapshots: a third of the work
[[nodiscard]] PaperPlan paper_plan(bool quick);

/// The shipped case with the run's settings.
[[nodiscard]] Case case_of(const PaperRun& run);

/// The command that gives the same, from the root of the project where `directory`, that of the
/// study, is given from there.
[[nodiscard]] std::string command_of(const PaperRun& run, const std::filesystem::path& directory);
[[nodiscard]] std::string command_of(const PaperPod& pod, const std::filesystem::path& directory);

}  // namespace rondo::study
