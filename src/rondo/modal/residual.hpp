// SPDX-License-Identifier: BSD-3-Clause
/// @file  Residual of a mode in (8.1), independent of the solvers: on all nodes of the mesh, with
/// the simple reference products of K.
#pragma once
#include "rondo/modal/modes.hpp"

namespace rondo::modal {

/// ‖(K' + λ²M + 2λsMJ) φ‖ / ‖K' φ‖, λ = γ + iω. For rigid-body motions at rest, K'φ is round-off,
/// and the denominator is ‖D φ‖ instead, where D is the block diagonal of K.
double residual(const CyclicBody& body, double spin, const Mode& mode);
double residual(const MeshBody& body, double spin, const Mode& mode);

}  // namespace rondo::modal
