// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace rondo {

std::string Fault::text() const {
  std::string text;
  if (!file.empty()) {
    text += file + ":";
    if (line > 0) text += fmt::format("{}:{}:", line, column);
    text += " ";
  }
  if (!key.empty()) text += key + (found.empty() ? ": " : " = " + found + ": ");
  text += message;
  if (!allowed.empty()) text += fmt::format(" (allowed: {})", allowed);
  return text;
}

namespace {
std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault.text();
  }
  return text;
}
}  // namespace

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(joined(faults)), faults_(std::move(faults)) {}

InputError::InputError(Fault fault) : InputError(std::vector<Fault>{std::move(fault)}) {}

InputError request_error(const std::string& option, const std::string& found,
                         const std::string& message, const std::string& allowed) {
  return InputError(Fault{"", 0, 0, option, found, message, allowed});
}

}  // namespace rondo
