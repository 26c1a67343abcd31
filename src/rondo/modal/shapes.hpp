// SPDX-License-Identifier: BSD-3-Clause
/// @file  Makes shapes on the nodes of the mesh from eigenvectors.
#pragma once
#include <span>
#include <vector>

#include "rondo/modal/harmonic_problem.hpp"
#include "rondo/modal/modes.hpp"

namespace rondo::modal {

/// Scales to φᴴ M φ = 1, with the phase at which the largest component is real and positive.
void normalise(Mode& mode, std::span<const double> mass);

/// The modes of a root of harmonic `n`: a wave; at rest the two standing waves that two opposite
/// waves form, shifted by a quarter of their length; one standing wave if the harmonic is its own
/// partner. @param partner 0 < n < N/2
template <int D>
std::vector<Mode> modes_of(const CyclicBody<D>& body, double spin, int n, bool partner,
                           const HarmonicRoot& root);

}  // namespace rondo::modal
