// SPDX-License-Identifier: BSD-3-Clause
/// @file  How well a mode fulfils (8.1), apart from the solvers: on all nodes of the mesh, with the
/// readable products of K.
#pragma once
#include "rondo/modal/modes.hpp"

namespace rondo::modal {

/// ‖(K' + λ²M + 2λsMJ) φ‖ / ‖K' φ‖, λ = γ + iω; where K'φ is round-off, of the rigid-body motions
/// at rest, over ‖D φ‖ instead, D the blocks of K on its diagonal.
double residual(const CyclicBody& body, double spin, const Mode& mode);
double residual(const MeshBody& body, double spin, const Mode& mode);

}  // namespace rondo::modal
