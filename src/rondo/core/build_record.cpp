// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/build_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "rondo/core/built_with.hpp"
#include "rondo/core/version.hpp"

namespace rondo {
namespace {

struct Sources {
  std::string commit = "unknown";
  std::optional<bool> modified;
};

Sources& sources_given() {
  static Sources sources;
  return sources;
}

/// Splits "name version;name version". A version that CMake did not find is "unknown".
std::vector<std::pair<std::string, std::string>> pairs_in(std::string_view list) {
  std::vector<std::pair<std::string, std::string>> pairs;
  while (!list.empty()) {
    const std::string_view one = list.substr(0, list.find(';'));
    list.remove_prefix(std::min(one.size() + 1, list.size()));
    const std::size_t space = one.find(' ');
    pairs.emplace_back(one.substr(0, space),
                       space + 1 < one.size() ? one.substr(space + 1) : "unknown");
  }
  return pairs;
}

}  // namespace

void set_commit(std::string commit, int modified) {
  sources_given().commit = std::move(commit);
  sources_given().modified = modified < 0 ? std::nullopt : std::optional(modified > 0);
}

BuildRecord build_record() {
  return {sources_given().commit, sources_given().modified, build_options, built_with_flags,
          pairs_in(built_with_libraries)};
}

std::string in_lines(const BuildRecord& r) {
  std::string libraries;
  for (const auto& [name, number] : r.libraries)
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, number);
  const char* changed = !r.modified ? "" : *r.modified ? ", with changes" : ", without changes";
  return fmt::format("commit     {}{}\ncompiler   {}\nflags      {}\nlibraries  {}\n", r.commit,
                     changed, r.compiler, r.flags, libraries);
}

}  // namespace rondo
