// SPDX-License-Identifier: BSD-3-Clause
/// @file  The case files of cases/, built into the program: what it runs by itself needs no folder
/// beside it.
#pragma once
#include <span>
#include <string_view>

namespace rondo::study {

struct ShippedCase {
  std::string_view name;  ///< "ledge-smooth" of cases/ledge-smooth.toml
  std::string_view text;
};

/// In the order of their names.
[[nodiscard]] std::span<const ShippedCase> shipped_cases() noexcept;
/// The text of one of them. @pre it is there
[[nodiscard]] std::string_view shipped_case(std::string_view name);

}  // namespace rondo::study
