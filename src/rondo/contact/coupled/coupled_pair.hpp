// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sweeps by pairs of contacts that hold nearly the same thing (two facets almost in line; a
/// node on a segment, and the segment's node on the other): alone, each would undo a small part of
/// the other's work at a time (docs/theory.md, 4.7b). Used by solve_coupled only.
#pragma once
#include <span>

#include "rondo/contact/coupled/coupled.hpp"

namespace rondo::contact {

/// The contact to which j is most strongly coupled, -1 where to none by more than half of what
/// would make the two redundant.
int partner_of(const CoupledProblem& problem, std::size_t j) noexcept;

/// Solves contacts j and l together, the others as they are, by trying all statuses of both until
/// the law holds to `enough` [N·s/m]; false, and nothing is changed, where none is much nearer to
/// the law than they are.
bool update_pair(const CoupledProblem& problem, std::array<std::size_t, 2> contacts, double enough,
                 std::span<Vec2> impulse) noexcept;

}  // namespace rondo::contact
