// SPDX-License-Identifier: BSD-3-Clause
/// @file  The members of a study that will be run; all are checked before the first one starts.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/figures/chosen_figures.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/case/case.hpp"
#include "rondo/study/sweep/sweep_plan.hpp"
#include "rondo/study/sweep/sweep_team.hpp"

namespace rondo::study {

/// Expected cost of a member, as far as it is known.
struct MemberCost {
  std::size_t memory_bytes = 0;  ///< peak memory
  std::size_t disk_bytes = 0;
  std::size_t nodes = 0, dofs = 0;
  long long steps = 0;   ///< or increments
  double seconds = 0.0;  ///< expected; 0: not requested, or not estimated
  std::vector<std::string> warnings;
};

/// Who runs a member.
enum class Part {
  own,    ///< this sweep, or this shard of it
  lent,   ///< another shard; run here as well, only for its modes
  other,  ///< another shard: it is read here but not built
};

struct PlannedMember : MemberCost {
  Member member;
  Part part = Part::own;
  std::string hash;          ///< of the case as run and of its mesh
  std::string body;          ///< of the body that members share, see body_key(), and the mesh
  std::string shared;        ///< of what members of one body share besides it; empty: nothing
  bool is_linear = true;     ///< whether all strains are meant to be small
  bool finds_modes = false;  ///< whether it is a crush by LATIN-PGD
  /// The member of the same body with whose modes it starts, if that has finished; none: it is the
  /// first of its body, or has no modes.
  std::optional<std::size_t> modes_of;
};

struct MembersRequest {
  const SweepStudy& study;
  bool seconds = false;  ///< whether to estimate them
  /// Receives the current stage, the number of members done and of all; may be empty.
  std::function<void(const char* what, long long done, long long all)> progress;
  /// Sets the parts of the members after reading and before building them; empty: all are own.
  std::function<void(std::vector<PlannedMember>& members)> choose;
  /// Throws an InputError for a case that is not to be run; may be empty.
  std::function<void(const Case&)> accept;

  /// For TeamWork::watch.
  [[nodiscard]] std::function<void(std::size_t)> watch(const char* what, std::size_t all) const;
};

struct PlannedSweep {
  const AnalysisType* type = nullptr;  ///< that of all members
  std::vector<ChosenFigure> chosen;    ///< in addition to the type's figures
  bool is_solid = false;               ///< whether bodies are wheels in three dimensions
  std::vector<PlannedMember> members;  ///< in the order of their numbers
  /// The order in which members are run: those that share a body, and what else they share,
  /// follow one another, the longest first.
  std::vector<std::size_t> order;
  bool stopped = false;  ///< before everything was checked
  /// Members have no directories: the runs are shorter than creating these, and are run again.
  bool direct = false;
};

/// Labels of a member's figures, in their order.
[[nodiscard]] std::vector<ColumnLabel> figure_labels(const PlannedSweep& plan);

/// Reads the cases of all members and builds every member that is run here. @throws InputError with
/// all faults of all members, each once, with the members that it concerns; FileError
[[nodiscard]] PlannedSweep plan_sweep(const MembersRequest& request, Team& team);

/// The order in phases, without members run elsewhere; each phase finishes before the next starts,
/// because members start with modes of members in earlier phases.
[[nodiscard]] std::vector<std::vector<std::size_t>> phases_of(const PlannedSweep& plan);

/// @throws InputError
[[nodiscard]] Case case_of(const SweepStudy& study, const PlannedMember& member);

}  // namespace rondo::study
