// SPDX-License-Identifier: BSD-3-Clause
/// @file  Blocks of lines KEY = value.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/road/crg/crg_header.hpp"
#include "rondo/road/crg/crg_text.hpp"

namespace rondo::road {

struct CrgValue {
  std::string key;   ///< upper case
  std::string text;  ///< as in the file
  double value = 0.0;
  int line = 0;
};

/// The values of one block; empty if the file has no such block.
struct CrgValues {
  std::string file, block;
  std::vector<CrgValue> values;

  [[nodiscard]] const CrgValue* find(std::string_view key) const noexcept;
  [[nodiscard]] std::optional<double> real(std::string_view key) const noexcept;
  [[nodiscard]] double real_or(std::string_view key, double otherwise) const noexcept;
  /// @throws InputError: not a whole number from 0 to `most`
  [[nodiscard]] std::optional<int> choice(std::string_view key, int most) const;
  /// Place of a key for a fault; line 0 if the block does not have it.
  [[nodiscard]] HeaderPlace place(std::string_view key) const;
  /// @throws InputError: about the value of the key
  [[noreturn]] void refuse(std::string_view key, const std::string& message,
                           const std::string& allowed) const;
};

/// @param known keys that the block may have
/// @throws InputError: a line without =, an unknown key, a value that is not a number, or a key
/// with two different values
[[nodiscard]] CrgValues read_crg_values(const CrgHeader& header, const std::string& block,
                                        std::span<const std::string_view> known);

}  // namespace rondo::road
