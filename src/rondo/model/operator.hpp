// SPDX-License-Identifier: BSD-3-Clause
/// @file  The stiffness product of the step, on any mesh: 2×2 block rows.
#pragma once
#include <span>

#include "rondo/model/model.hpp"

namespace rondo::dynamics {

/// out = K u, both (n); rows of clamped nodes give 0. Same bits for any number of threads.
void apply(const fem::BlockCsr& k, std::span<const Vec2> u, std::span<Vec2> out,
           int threads) noexcept;

/// The same by what the model has: the assembled stiffness, else that of one sector.
void apply_stiffness(const Model& model, std::span<const Vec2> u, std::span<Vec2> out);

}  // namespace rondo::dynamics
