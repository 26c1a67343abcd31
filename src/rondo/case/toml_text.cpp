// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/toml_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::study {

std::string toml_number(double value) {
  RONDO_DEMAND(std::isfinite(value), value);
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (c == '\n')
      quoted += "\\n";
    else if (c == '\t')
      quoted += "\\t";
    else if (code < 0x20 || code == 0x7f)
      quoted += fmt::format("\\u{:04X}", code);
    else
      quoted += c;
  }
  return quoted + '"';
}

}  // namespace rondo::study
