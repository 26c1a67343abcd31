// SPDX-License-Identifier: BSD-3-Clause
/// @file  The meaning of a key must be readable alone, because an editor shows it at the cursor.
#pragma once
#include <string_view>

namespace rondo::test {

/// Empty if the text can be read without other rows; otherwise the reason why not.
inline std::string_view fault_of_meaning(std::string_view text) {
  if (text.empty()) return "is empty";
  const char first = text.front();
  const bool capital = first >= 'A' && first <= 'Z', digit = first >= '0' && first <= '9';
  if (!capital && !digit && first != '"' && first != '`')
    return "begins with no capital letter, digit, quotation mark or backtick";
  for (const std::string_view reference : {"likewise", "Likewise", "ditto", "Ditto", "as above"})
    if (text.find(reference) != std::string_view::npos) return "refers to another row";
  if (text.ends_with(',') || text.ends_with("...")) return "is not finished";
  return {};
}

}  // namespace rondo::test
