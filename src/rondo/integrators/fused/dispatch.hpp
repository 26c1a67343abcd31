// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which instruction set the inner loops use (docs/performance.md).
#pragma once
#include <span>

#include "rondo/integrators/fused/kernels/kernels.hpp"

namespace rondo::dynamics {

/// Every level of this machine, the best first.
std::span<const kernels::Table* const> kernel_tables() noexcept;

/// The best level of this machine, or the one that the environment variable RONDO_DISPATCH names
/// ("avx512", "avx2", "baseline"). Chosen once. @throws InputError: unknown, or not of this
/// machine.
const kernels::Table& kernel_table();

}  // namespace rondo::dynamics
