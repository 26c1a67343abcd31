// SPDX-License-Identifier: BSD-3-Clause
/// @file  How often this program has asked for memory: by new, and by malloc (matrices of Eigen do)
/// where it is linked with --wrap=malloc.
#pragma once

namespace rondo::test {

[[nodiscard]] long allocations() noexcept;

}  // namespace rondo::test
