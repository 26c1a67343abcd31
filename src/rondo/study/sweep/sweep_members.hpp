// SPDX-License-Identifier: BSD-3-Clause
/// @file  The members of a study as they will be run, checked before the first of them begins.
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

/// What a member would cost, as far as it is known.
struct MemberCost {
  std::size_t memory_bytes = 0;  ///< at its largest
  std::size_t disk_bytes = 0;
  std::size_t nodes = 0, dofs = 0;
  long long steps = 0;   ///< or increments
  double seconds = 0.0;  ///< expected; 0: not asked for, or not estimated
  std::vector<std::string> warnings;
};

/// Who makes a member.
enum class Part {
  own,    ///< this sweep, or this shard of it
  lent,   ///< another shard; made here as well, for its modes alone
  other,  ///< another shard: it is read here and not built
};

struct PlannedMember : MemberCost {
  Member member;
  Part part = Part::own;
  std::string hash;          ///< of the case as run and its mesh
  std::string body;          ///< of what members share, see body_key(), and the mesh
  bool is_linear = true;     ///< no part is rubber
  bool finds_modes = false;  ///< a crush by LATIN-PGD
  /// Member of the same body whose modes it begins with, where that one is done; none: it is the
  /// first of its body, or has no modes.
  std::optional<std::size_t> modes_of;
};

struct MembersRequest {
  const SweepStudy& study;
  bool seconds = false;  ///< estimate them
  /// Takes what is counted, how many of them are done, how many there are; may be empty.
  std::function<void(const char* what, long long done, long long all)> progress;
  /// Sets the parts of the members when they are read, before any is built; empty: all are own.
  std::function<void(std::vector<PlannedMember>& members)> choose;

  /// For TeamWork::watch.
  [[nodiscard]] std::function<void(std::size_t)> watch(const char* what, std::size_t all) const;
};

struct PlannedSweep {
  const AnalysisType* type = nullptr;  ///< of all members
  std::vector<ChosenFigure> chosen;    ///< besides the type's figures
  bool is_solid = false;               ///< wheels in three dimensions: of the units
  std::vector<PlannedMember> members;  ///< in the order of their numbers
  /// Members in the order in which they are done: those that share a body one after the other, the
  /// longest first.
  std::vector<std::size_t> order;
  bool stopped = false;  ///< before all was checked
  /// Members have no directories: they take less time than these would, and are made anew.
  bool direct = false;
};

/// Labels of the figures of a member, in their order.
[[nodiscard]] std::vector<ColumnLabel> figure_labels(const PlannedSweep& plan);

/// Reads every member's case, builds every member once that is made here. @throws InputError with
/// all faults of all members, each once, with the members that it concerns; FileError
[[nodiscard]] PlannedSweep plan_sweep(const MembersRequest& request, Team& team);

/// The order in parts, without the members that are made elsewhere, of which each is done before
/// the next: members begin with modes of those in parts before.
[[nodiscard]] std::vector<std::vector<std::size_t>> phases_of(const PlannedSweep& plan);

/// @throws InputError
[[nodiscard]] Case case_of(const SweepStudy& study, const PlannedMember& member);

}  // namespace rondo::study
