// SPDX-License-Identifier: BSD-3-Clause
/// @file  Typed access to the values of a case file or a study file. Each read checks type and
/// bounds against the table of keys and collects faults, so that one pass reports all of them.
#pragma once
#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/model/motion.hpp"

namespace rondo::study {

/// The table of keys of a kind of file, as needed for messages. Paths may have indices.
struct KeysOfFile {
  bool (*is_key)(std::string_view path);
  bool (*is_table)(std::string_view path);
  bool (*is_list)(std::string_view path);
  std::string (*keys_in)(std::string_view table);    ///< as one list; "": those at the top
  std::string (*allowed_at)(std::string_view path);  ///< allowed values of a key
  std::string (*meant_by)(std::string_view path);    ///< suggestion for an unknown key, or ""
};
extern const KeysOfFile keys_of_case;

class CaseValues {
 public:
  /// Finds keys that do not exist, and keys of tables or lists of tables with another type.
  explicit CaseValues(CaseSource source, const KeysOfFile& keys = keys_of_case);

  [[nodiscard]] bool has(std::string_view key) const { return source_.values.contains(key); }
  [[nodiscard]] bool has_table(std::string_view table) const;
  /// Null: no value is given for the key.
  [[nodiscard]] const CaseValue* find(std::string_view key) const;
  /// The line of a table, or of the table that contains it, in the file; 0: there is none.
  [[nodiscard]] int line_of(std::string_view table) const { return place_of_table(table).line; }
  /// Whether an array is given for the key.
  [[nodiscard]] bool has_array(std::string_view key) const;
  /// Number of tables in a list; they are item_of(list, 0) and so on.
  [[nodiscard]] std::size_t n_items(std::string_view list) const;
  /// Whether none of the keys has a fault so far or is missing.
  [[nodiscard]] bool good(std::initializer_list<std::string_view> keys) const;

  /// Reads a value into its field, which keeps its default if the key is absent or faulty.
  /// @param path with the number of the table, if that is in a list
  void read(const CaseKey& key, const std::string& path, const CaseMember& field) {
    read(key.allowed, key.use.required, path, field);
  }
  /// Reads a value within the bounds given. @param required  a text must not be empty
  void read(const Allowed& allowed, bool required, const std::string& path,
            const CaseMember& field);

  /// Adds a fault of a key: at its value, else at its table; or at an item of its array.
  void fault(std::string_view key, std::string message, std::string allowed = {});
  /// Adds a fault of a key, unless it already has one.
  void refuse(std::string_view key, std::string message, std::string allowed) {
    if (good({key})) fault(key, std::move(message), std::move(allowed));
  }
  /// Adds a fault in a file that a key names, with its own file and line, at the place of the key.
  void fault_in_file(std::string_view key, Fault fault);
  void fault_at_item(std::string_view key, int item, std::string message);
  void missing(std::string_view key);

  /// Places of all given values and tables, for faults found only once the case is complete.
  [[nodiscard]] std::map<std::string, KeyPlace> places() const;

  /// @throws InputError if there are faults: in the order of the file, then those of the settings.
  void finish();

 private:
  struct Located {
    Place place;
    Fault fault;
  };
  /// The key that is being read: its allowed values, its path and the given value.
  struct Reading {
    const Allowed& allowed;
    bool required;
    const std::string& path;
    const CaseValue& value;
  };
  void add(const Place& place, std::string_view key, std::string found, std::string message,
           std::string allowed);
  void bad(const Reading& in, const CaseValue& value, std::string message);
  void wrong_type(const Reading& in, const CaseValue& value, std::string_view asked);
  bool finite(const Reading& in, const CaseValue& value, double& target);
  bool pair(const Reading& in, const CaseValue& value, std::array<double, 2>& target);
  std::vector<std::array<double, 2>> pairs(const Reading& in);
  std::optional<double> number(const Reading& in);
  std::optional<std::string> text(const Reading& in);
  void take(const Reading& in, int& target);
  void take(const Reading& in, bool& target);
  void take(const Reading& in, std::string& target);
  void take(const Reading& in, const Choice& target);
  void take(const Reading& in, const ChoiceList& target);
  void take(const Reading& in, Vec2& target);
  void take(const Reading& in, Matrix& target);
  void take_points(const Reading& in, dynamics::Table& target);
  void take(const Reading& in, dynamics::Table& target);
  void take(const Reading& in, std::vector<Vec2>& target);
  void take(const Reading& in, std::vector<int>& target);
  void take(const Reading& in, std::vector<std::array<double, 2>>& target);
  void take(const Reading& in, std::vector<std::string>& target);
  void take_profile_file(const Reading& in, std::vector<Vec2>& target);
  void check_key(const std::string& path, const CaseValue& value);
  void not_a_list(const std::string& path, const CaseValue& value);
  void add_missing_tables();
  [[nodiscard]] std::vector<Fault> first_of_each_key();
  [[nodiscard]] Place place_of_table(std::string_view table) const;

  CaseSource source_;
  const KeysOfFile* keys_;
  std::vector<Located> faults_;
  std::set<std::string, std::less<>> bad_keys_;
  std::map<std::string, std::vector<std::string>, std::less<>> missing_;  ///< keys by absent table
  std::string profile_file_;        ///< of the ground; empty: there is none
  std::vector<int> profile_lines_;  ///< lines of the points in that file
};

}  // namespace rondo::study
