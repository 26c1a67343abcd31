// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contacts that are solved together, step after step: their problem, which is put together
/// contact by contact, its solution, and what a step leaves to the next (docs/theory.md, 4.7).
/// Every step with coupled contacts uses it. Memory only grows.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "rondo/contact/coupled/problem_file.hpp"

namespace rondo::contact {

/// Impulses of a step by the keys of its contacts, ascending.                             [N·s/m]
using KeptImpulses = std::vector<std::pair<std::uint64_t, Vec2>>;
/// The impulse on the contact of this key; 0: there was no such contact.
[[nodiscard]] Vec2 kept_impulse(const KeptImpulses& kept, std::uint64_t key) noexcept;

/// The larger diagonal entry of a block.
inline double larger_diagonal(const Block& w) noexcept {
  return std::max(w[0], w[3]);
}

struct CoupledContacts {
  /// @param keep_above see DifficultProblems::look_at
  explicit CoupledContacts(CoupledLimits of, int keep_above = 0)
      : limits(of), dump_above(keep_above) {}

  /// Begins a problem, to which add() adds contacts.
  void clear();
  /// @param free w without impulses [m/s]   @param from impulse from which solve() starts [N·s/m]
  void add(Vec2 free, double bounce, double friction, Vec2 from);
  /// Couples every contact with every other: W_jl = block(j, l). The mass of contact j is
  /// 1/scale(W_jj). @pre all contacts were added; otherwise a DelassusBuilder gives the operator.
  template <class BlockOf>
  void couple_all(BlockOf&& block, double (*scale)(const Block&) noexcept = larger_diagonal);
  /// Finds `impulse` and `status`, and keeps the problem where it was difficult.
  const CoupledResult& solve();

  /// Impulse of the previous step, see kept_impulse().
  [[nodiscard]] Vec2 kept_of(std::uint64_t key) const noexcept { return kept_impulse(kept, key); }
  void sort_kept() noexcept;

  CoupledLimits limits;
  int dump_above;
  CoupledProblem problem;
  std::vector<Vec2> impulse;   ///< (nc) found, and before solve() the warm start      [N·s/m]
  std::vector<Status> status;  ///< (nc)
  CoupledResult result;
  KeptImpulses kept;  ///< of the previous step: a user of kept_of() writes them
  DifficultProblems difficult;
  CoupledWorkspace workspace;
  std::vector<Vec2> start;  ///< (nc) copy of the warm start
};

template <class BlockOf>
void CoupledContacts::couple_all(BlockOf&& block, double (*scale)(const Block&) noexcept) {
  const std::size_t n = problem.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t l = 0; l < n; ++l) {
      problem.column.push_back(static_cast<int>(l));
      problem.blocks.push_back(block(j, l));
    }
    problem.mass.push_back(1.0 / scale(problem.blocks[j * n + j]));
    problem.row_start.push_back(static_cast<int>(problem.column.size()));
  }
}

}  // namespace rondo::contact
