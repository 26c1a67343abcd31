// SPDX-License-Identifier: BSD-3-Clause
/// @file  The stiffness product on any mesh, by rows of 2×2 blocks.
#pragma once
#include <span>

#include "rondo/fem/assembly.hpp"

namespace rondo::fem {

/// out = K u, both (n); rows of clamped nodes give 0. Same bits for any number of threads.
void apply(const BlockCsr& k, std::span<const Vec2> u, std::span<Vec2> out, int threads) noexcept;

}  // namespace rondo::fem
