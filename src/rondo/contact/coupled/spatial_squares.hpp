// SPDX-License-Identifier: BSD-3-Clause
/// @file  Least squares for contacts in space that share nodes, where sweeps are slow or go round:
/// contacts that hold nearly the same thing. The law is one equation F(r) = r - P(r - m ŵ) = 0 with
/// the projection P on the cones (residual.hpp), solved by the method of Levenberg and Marquardt
/// (D. W. Marquardt, J. SIAM 11 (1963) 431), which takes singular operators. Used by solve_coupled
/// only.
#pragma once
#include <span>

#include "rondo/contact/coupled/spatial_coupled.hpp"

namespace rondo::contact {

/// Improves `impulse` (nc) until F is round-off, or no step makes it smaller. The impulses need not
/// obey the cones when they leave. @param share of each contact's μ that counts, 0 to 1
/// @return steps made
int least_squares(const SpatialCoupled& problem, double share, std::span<Vec3> impulse,
                  SpatialWorkspace& work);

}  // namespace rondo::contact
