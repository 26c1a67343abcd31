// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace rondo {

/// The subscript of an array for a number of a node, cell or row, which is an int and not negative.
[[nodiscard]] constexpr std::size_t at(int number) noexcept {
  return static_cast<std::size_t>(number);
}

}  // namespace rondo
