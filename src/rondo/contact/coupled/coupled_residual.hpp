// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far the impulses of a coupled problem are from the law, computed without its solvers
/// (docs/theory.md, 4.5, 4.7).
#pragma once
#include <span>

#include "rondo/contact/coupled/coupled.hpp"

namespace rondo::contact {

/// Largest |r_j - P_K(r_j - m_j ŵ_j)| over the largest m_j |free_j| [-]; 0 where both are
/// zero and the impulses too. `impulse` (nc).
double coupled_residual(const CoupledProblem& problem, std::span<const Vec2> impulse) noexcept;

}  // namespace rondo::contact
