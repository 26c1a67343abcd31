// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far an impulse and a velocity are from the law, computed without the solver: the same
/// measure judges every solver (docs/theory.md, 4.5). Natural map of De Saxcé and Feng, Math.
/// Comput. Modelling 28 (1998) 225: r = P_K(r - m ŵ), ŵ = w + (bounce + μ|w_t|) n.
#pragma once
#include "rondo/core/vec2.hpp"

namespace rondo::contact {

/// Nearest point of the friction cone |y| <= μ x.
Vec2 project_on_cone(Vec2 r, double friction) noexcept;

/// |r - P_K(r - m ŵ)| [N·s/m]: zero exactly where the law holds. `mass` > 0 only sets the scale
/// at which velocities weigh against impulses.
double law_residual(Vec2 impulse, Vec2 velocity, double bounce, double friction,
                    double mass) noexcept;

}  // namespace rondo::contact
