// SPDX-License-Identifier: BSD-3-Clause
/// @file  Residual of a mode in (8.1), independent of the solvers: on all nodes of the mesh, with
/// the simple reference products of K; and how fast damping lets it decay.
#pragma once
#include "rondo/modal/modes.hpp"

namespace rondo::modal {

/// ‖(K' + λ²M + 2λsMJ) φ‖ / ‖K' φ‖, λ = γ + iω. For rigid-body motions at rest, K'φ is round-off,
/// and the denominator is ‖D φ‖ instead, where D is the block diagonal of K.
template <int D>
double residual(const CyclicBody<D>& body, double spin, const Mode& mode);
double residual(const MeshBody& body, double spin, const Mode& mode);

/// α [1/s] and β [s] of the damping αM + βK.
struct Damping {
  double mass = 0.0, stiffness = 0.0;
};

/// Forms of the shape φ of an undamped mode, which has φᴴMφ = 1.
struct ModeForms {
  double gyroscopic = 0.0;  ///< φᴴ 2sMJ φ/i                                           [rad/s]
  double softening = 0.0;   ///< φᴴ s²MP φ                                          [1/s²]
  double elastic = 0.0;     ///< φᴴ K φ, by (8.1)                                   [1/s²]
};
/// @param mass (n)
ModeForms forms_of(std::span<const double> mass, double spin, const Mode& mode);

/// Rate at which damping lets a mode decay, over ω: (αm + βk)/(2ω + g) with m = 1, k = φᴴKφ and g =
/// φᴴ2sMJφ/i, for φ of the undamped body. At rest it is (α/ω + βω)/2, exactly; in spin an error of
/// second order in the damping remains. NaN of rigid-body motions. @param mass (n)
double damping_ratio(std::span<const double> mass, double spin, const Mode& mode, Damping damping);

}  // namespace rondo::modal
