// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case file and its --set as flat lists of keys with values and positions; the only file
/// that includes toml++. It does not know the meaning of keys, except which of them are tables and
/// lists of tables; the k-th table of a list is "list[k]", from 0.
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

/// From the first character of a text to the one after its last; counted from 1, 0: unknown.
struct Place {
  int source = 0;  ///< 0: the case file; k: the k-th --set
  int line = 0, column = 0, end_line = 0, end_column = 0;
};

enum class ValueType { text, integer, number, boolean, date, array, table };

struct CaseValue {
  ValueType type = ValueType::table;
  Place place;          ///< of the value
  Place key_place;      ///< of the key (not for items of arrays)
  double number = 0.0;  ///< also for integers
  std::int64_t integer = 0;
  bool boolean = false;
  std::string text;
  std::vector<CaseValue> items;  ///< of an array
};

/// The source of a value: name and text of the case file or of one --set.
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

  /// The text at a place, shortened to one line.
  [[nodiscard]] std::string written(const Place& place) const;
};

/// The keys of a kind of file that are opened as tables or lists of tables; all others are values.
struct TomlShape {
  std::string_view what;  ///< "a case file", for messages
  bool (*is_table)(std::string_view path);
  bool (*is_list)(std::string_view path);
};

/// The text of a file given by the user. @param what  "a case file", for messages
/// @throws InputError if it is missing, a directory, above 16 MB, or cannot be read.
std::string read_input(const std::filesystem::path& file, std::string_view what);

/// A file of any kind, without settings. @throws InputError if it cannot be read or is not TOML.
CaseSource load_toml(const std::filesystem::path& file, const TomlShape& shape);
/// Loads a text instead of a file; messages call it `name`.
CaseSource load_toml_text(const std::string& name, std::string text, const TomlShape& shape);

/// Reads the file and applies the settings. @throws InputError if the file cannot be read or is not
/// TOML.
CaseSource load_case(const std::filesystem::path& file, const std::vector<std::string>& settings);
/// Loads the text of a case; messages call it `name`. @throws InputError if it is not TOML.
CaseSource load_case_text(const std::string& name, std::string text,
                          const std::vector<std::string>& settings);

/// The text itself if it is UTF-8, else with '?' instead of the bytes outside ASCII.
std::string as_utf8(std::string text);

/// The value as TOML that reads back to the same value. @pre no table, no date
std::string toml_text(const CaseValue& value);

/// "a string", "an integer", ...
std::string_view type_word(ValueType type) noexcept;

}  // namespace rondo::study
