// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>

namespace rondo {

/// The array index of a node, cell or row, whose number is signed and not negative. Numbers are
/// signed throughout, because -1 means "none" and differences are needed; containers are not.
template <std::signed_integral Number>
[[nodiscard]] constexpr std::size_t at(Number number) noexcept {
  return static_cast<std::size_t>(number);
}

}  // namespace rondo
