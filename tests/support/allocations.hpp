// SPDX-License-Identifier: BSD-3-Clause
/// @file  How often this program has asked for memory, by new or by malloc (matrices of Eigen do);
/// of programs that are linked with count_allocations.cpp.
#pragma once

namespace rondo::test {

[[nodiscard]] long allocations() noexcept;

}  // namespace rondo::test
