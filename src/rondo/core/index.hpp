// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace rondo {

/// The array index of a node, cell or row, whose number is a non-negative int.
[[nodiscard]] constexpr std::size_t at(int number) noexcept {
  return static_cast<std::size_t>(number);
}

}  // namespace rondo
