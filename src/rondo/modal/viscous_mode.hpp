// SPDX-License-Identifier: BSD-3-Clause
/// @file  Frequency and damping of a mode of a viscous body (docs/modes.md): its branches, taken
/// along the shape that the mode has at slow strains.
#pragma once
#include "rondo/fem/viscosity.hpp"
#include "rondo/modal/modes.hpp"
#include "rondo/modal/residual.hpp"

namespace rondo::modal {

/// Sets mode.omega to |λ|, λ the root near the mode of
///   λ² + λ (i g + α + β k) + k' + Σ h(λ) φᴴ V φ = 0,   h = Σ r λτ/(1 + λτ),
/// with g = φᴴ 2sMJ φ/i, k' = φᴴ K' φ and k = φᴴ K φ. It is exact at rest where all of the body has
/// the same branches, V = K and β or V alone; else shapes have an error of first order in the loss,
/// and λ one of second order.
/// @param mass (n). @return -Re λ/|λ|; NaN of rigid-body motions, and of modes that are overdamped:
/// these stay as they are
template <class Stiffness>
double take_branches(std::span<const fem::ViscousPart<Stiffness>> parts,
                     std::span<const double> mass, double spin, Damping damping, Mode& mode);

}  // namespace rondo::modal
