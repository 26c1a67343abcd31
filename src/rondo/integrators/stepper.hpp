// SPDX-License-Identifier: BSD-3-Clause
/// @file  The CD-Lagrange step (docs/theory.md, section 3): displacements and forces at t_n,
/// velocities and impulses at t_{n+1/2}. The readable reference, one loop per line of the scheme,
/// on one thread: the integrators of a run (integrator.hpp) must match it. Source: Fekak et al.,
/// Comput. Mech. 60 (2017) 1; Adam et al., CSMA 2017.
#pragma once
#include <vector>

#include "rondo/model/contact_node.hpp"
#include "rondo/model/ledger.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// State at t = 0 from u_0 and v_0 (n each, turning frame): K u_0 and v_{1/2} by half a step
/// without contact (3.7). Displacements and velocities of clamped nodes are ignored.
State start(const Model& model, std::vector<Vec2> u0, std::vector<Vec2> v0);

/// One step: from (u_n, v_{n+1/2}) to (u_{n+1}, v_{n+3/2}). Allocates nothing.
[[nodiscard]] ContactReport advance(const Model& model, State& state, Ledger& ledger) noexcept;

}  // namespace rondo::dynamics
