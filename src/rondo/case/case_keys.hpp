// SPDX-License-Identifier: BSD-3-Clause
/// @file  The keys of a case file: one table for the reader, its messages and docs/cases.md.
#pragma once
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace rondo::study {

enum class KeyType { integer, number, boolean, text, choice, history, profile, vector, matrix };

/// Bounds of a number; infinite: none on that side.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is out
  bool high_open = false;  ///< high itself is out

  /// False for NaN.
  [[nodiscard]] bool contains(double value) const noexcept;
};

struct CaseKey {
  std::string_view path;      ///< dotted, e.g. "disk.tread.depth"; "output.probe[].name": of each
                              ///< table of a list
  KeyType type;               ///< what kind of value
  std::string_view unit;      ///< "-": none
  Range range;                ///< of numbers
  std::string_view also;      ///< a bound that involves other keys, or none
  std::string_view standard;  ///< the default; "required"; "required if ...": by the reader
  std::string_view meaning;
  std::array<std::string_view, 3> choices{};  ///< in the order of the enum they stand for

  [[nodiscard]] bool required() const noexcept { return standard == "required"; }
};

/// All keys, in the order in which a case is written.
std::span<const CaseKey> case_keys() noexcept;

/// Null where there is no such key. Tables of lists are named by their number:
/// "output.probe[0].name".
const CaseKey* find_case_key(std::string_view path);

/// A table of a case file, e.g. "disk.tread", "output.probe[0]".
bool is_case_table(std::string_view path);

/// A list of tables of a case file, e.g. "output.probe".
bool is_case_list(std::string_view path);

/// "output.probe" and 2 to "output.probe[2]".
std::string item_of(std::string_view list, std::size_t index);

/// "output.probe[2].name" to "output.probe[].name".
std::string without_indices(std::string_view path);

/// "float", "integer", ...: TOML's words, for the manual.
std::string_view type_text(const CaseKey& key) noexcept;

/// What may stand there, e.g. "> 0 and < disk.outer_radius".
std::string allowed_text(const CaseKey& key);

/// The keys of a table as one list; "": the tables and keys at the top.
std::string keys_text(std::string_view table);

/// The table a dotted key stands in ("" at the top), and the part after it.
std::string_view table_of(std::string_view path) noexcept;
std::string_view leaf_of(std::string_view path) noexcept;

/// The key or table that was probably meant; empty: nothing is near. A key of the right name in the
/// wrong table counts as near.
std::string_view nearest_key(std::string_view path);

}  // namespace rondo::study
