// SPDX-License-Identifier: BSD-3-Clause
/// @file  The keys of a study file: one table, from which come what the reader knows, what its
/// messages allow, and `rondo schema study`.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "rondo/case/schema/json_schema.hpp"
#include "rondo/study/sweep/sweep_study.hpp"

namespace rondo::study {

inline constexpr std::string_view sample_kind = "latin-hypercube";
inline constexpr Range sample_counts{1.0, static_cast<double>(most_members), false, false};
inline constexpr Range sample_seeds{0.0, std::numeric_limits<double>::infinity(), false, false};
inline constexpr Range linspace_counts{2.0, static_cast<double>(most_members), false, false};
/// What lies between two of them is a number too.
inline constexpr Range ends{-1e300, 1e300, false, false};

struct StudyKey {
  std::string_view path;      ///< "base"; "vary[].key": of each [[vary]]
  std::string_view allowed;   ///< for messages
  std::string_view standard;  ///< "required", or what holds where it is left out
  std::string_view meaning;
  Json (*schema)();  ///< of its value
};

/// The keys of a table side by side, in the order of docs/studies.md.
std::span<const StudyKey> study_keys() noexcept;

/// Null where there is no such key. @param path  tables of lists by their number: "vary[0].key"
const StudyKey* find_study_key(std::string_view path);

/// "sample", "vary": tables and the list of tables.
bool is_study_table(std::string_view path);
bool is_study_list(std::string_view path);

/// "base, set, ..., [[vary]], [sample], [window]" @param table  "", "vary[]", ...
std::string study_keys_text(std::string_view table);

/// The study's keys that are the same in all members: what may not be varied. @param key of a case
bool may_be_varied(std::string_view key);

/// A study file as a JSON Schema, as case_schema().
Json study_schema();

}  // namespace rondo::study
