// SPDX-License-Identifier: BSD-3-Clause
/// @file  The keys of a study file as one table. The reader, the allowed values in its messages,
/// and `rondo schema study` use it.
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
/// Limits such that the difference of two values is also a finite number.
inline constexpr Range ends{-1e300, 1e300, false, false};

struct StudyKey {
  std::string_view path;      ///< "base"; "vary[].key": of each [[vary]]
  std::string_view allowed;   ///< for messages
  std::string_view standard;  ///< "required", or what applies if it is absent
  std::string_view meaning;
  Json (*schema)();  ///< of its value
};

/// The keys in the order of docs/studies.md; those of one table are adjacent.
std::span<const StudyKey> study_keys() noexcept;

/// Null if there is no such key. @param path  tables in lists by their number: "vary[0].key"
const StudyKey* find_study_key(std::string_view path);

/// Whether it is "sample", "vary", ...: a table or a list of tables.
bool is_study_table(std::string_view path);
bool is_study_list(std::string_view path);

/// "base, set, ..., [[vary]], [sample], [window]" @param table  "", "vary[]", ...
std::string study_keys_text(std::string_view table);

/// Whether a key may vary; keys that must be equal in all members may not. @param key of a case
bool may_be_varied(std::string_view key);

/// A study file as a JSON Schema, like case_schema().
Json study_schema();

}  // namespace rondo::study
