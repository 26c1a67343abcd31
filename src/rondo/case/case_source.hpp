// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case file and its --set as flat lists of keys with values and places; the only includer
/// of toml++. What the keys mean is not known here, except which of them are tables and lists of
/// tables, whose k-th table is "list[k]", from 0.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/core/error.hpp"

namespace rondo::study {

/// From the first character of a piece of text up to the one after its last; from 1, 0: unknown.
struct Place {
  int source = 0;  ///< 0: the case file; k: the k-th --set
  int line = 0, column = 0, end_line = 0, end_column = 0;
};

enum class ValueType { text, integer, number, boolean, date, array, table };

struct CaseValue {
  ValueType type = ValueType::table;
  Place place;          ///< of the value
  Place key_place;      ///< of the key (not for items of arrays)
  double number = 0.0;  ///< of integers as well
  std::int64_t integer = 0;
  bool boolean = false;
  std::string text;
  std::vector<CaseValue> items;  ///< of an array
};

/// Where something comes from: the case file's name and text, or those of one --set.
struct SourceText {
  std::string name;
  std::string text;
  std::vector<std::size_t> line_begin;  ///< offsets in the text
};

struct CaseSource {
  std::vector<SourceText> sources;                        ///< the case file, then each --set
  std::map<std::string, Place, std::less<>> tables;       ///< by dotted path
  std::map<std::string, std::size_t, std::less<>> lists;  ///< number of tables, by dotted path
  std::map<std::string, CaseValue, std::less<>> values;   ///< by dotted path
  std::vector<Fault> bad_settings;  ///< --set that is not "a.b=value", or beyond a list's end

  /// The text at a place, on one line, shortened.
  [[nodiscard]] std::string written(const Place& place) const;
};

/// What of a kind of file is opened: tables, and lists of tables; anything else is a value.
struct TomlShape {
  std::string_view what;  ///< "a case file", for messages
  bool (*is_table)(std::string_view path);
  bool (*is_list)(std::string_view path);
};

/// The text of a file that the user gave. @param what  "a case file", for messages
/// @throws InputError where it is not there, a directory, above 16 MB, or cannot be read.
std::string read_input(const std::filesystem::path& file, std::string_view what);

/// A file of any kind, without settings. @throws InputError where it cannot be read or is not TOML.
CaseSource load_toml(const std::filesystem::path& file, const TomlShape& shape);
/// The same from a text that messages call `name`.
CaseSource load_toml_text(const std::string& name, std::string text, const TomlShape& shape);

/// Reads the file and applies the settings. @throws InputError where the file cannot be read or is
/// not TOML.
CaseSource load_case(const std::filesystem::path& file, const std::vector<std::string>& settings);
/// The same from a text that messages call `name`. @throws InputError where it is not TOML.
CaseSource load_case_text(const std::string& name, std::string text,
                          const std::vector<std::string>& settings);

/// The text itself if it is UTF-8, else with '?' for the bytes outside ASCII.
std::string as_utf8(std::string text);

/// The value as TOML that reads back to the same value. @pre no table, no date
std::string toml_text(const CaseValue& value);

/// "a string", "an integer", ...
std::string_view type_word(ValueType type) noexcept;

}  // namespace rondo::study
