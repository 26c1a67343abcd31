// SPDX-License-Identifier: BSD-3-Clause
/// @file  From eigenvectors to shapes on the nodes of the mesh.
#pragma once
#include <span>
#include <vector>

#include "rondo/modal/harmonic_problem.hpp"
#include "rondo/modal/modes.hpp"

namespace rondo::modal {

/// φᴴ M φ = 1, and the phase at which the largest component is real and positive.
void normalise(Mode& mode, std::span<const double> mass);

/// The modes of a root of harmonic `n`: a wave; at rest the two standing waves, a quarter of their
/// length apart, that two waves against each other make; one standing wave where the harmonic is
/// its own partner. @param partner 0 < n < N/2
std::vector<Mode> modes_of(const CyclicBody& body, double spin, int n, bool partner,
                           const HarmonicRoot& root);

}  // namespace rondo::modal
