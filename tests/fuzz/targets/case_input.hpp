// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case file with --set in one text: each line "#--set KEY=VALUE" is one.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz.hpp"
#include "rondo/case/case.hpp"

namespace rondo::fuzz {

inline std::vector<std::string> settings_in(std::string_view text) {
  constexpr std::string_view mark = "#--set ";
  std::vector<std::string> settings;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.starts_with(mark)) settings.emplace_back(line.substr(mark.size()));
  }
  return settings;
}

/// By way of a file, whose own checks belong to it. `folder` is where meshes are looked for.
inline study::Case read_case_input(std::string_view text, const std::filesystem::path& folder) {
  const auto file = folder / "case.toml";
  put(file, text);
  return study::read_case(file, settings_in(text));
}

}  // namespace rondo::fuzz
