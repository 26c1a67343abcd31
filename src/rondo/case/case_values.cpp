// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "rondo/case/ground/profile_file.hpp"
#include "rondo/case/numbers/foreign_writing.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

constexpr std::size_t most_faults_of_a_key = 5;

bool is_case_key(std::string_view path) {
  return find_case_key(path) != nullptr;
}

std::string allowed_in_case(std::string_view path) {
  const CaseKey* key = find_case_key(path);
  RONDO_DEMAND(key != nullptr, path);
  return allowed_text(*key);
}

std::string unknown_text(const CaseValue& value, const std::string& meant) {
  const std::string_view said = value.type == ValueType::table ? "unknown table" : "unknown key";
  return fmt::format("{}{}{}", said, meant.empty() ? "" : "; ", meant);
}

std::string keys_beside(const KeysOfFile& keys, std::string_view path) {
  std::string_view table = table_of(path);
  while (!table.empty() && !keys.is_table(table)) table = table_of(table);
  const std::string where = table.empty() ? "at the top" : fmt::format("in [{}]", table);
  return fmt::format("{}: {}", where, keys.keys_in(table));
}

}  // namespace

const KeysOfFile keys_of_case{is_case_key, is_case_table,   is_case_list,
                              keys_text,   allowed_in_case, meant_text};

CaseValues::CaseValues(CaseSource source, const KeysOfFile& keys)
    : source_(std::move(source)), keys_(&keys) {
  for (const auto& [path, value] : source_.values) check_key(path, value);
}

void CaseValues::check_key(const std::string& path, const CaseValue& value) {
  const std::string found =
      value.type == ValueType::table ? std::string{} : source_.written(value.place);
  if (keys_->is_table(path) && !keys_->is_key(path))
    fault(path, fmt::format("must be a table, not {}", type_word(value.type)),
          keys_->keys_in(path));
  else if (keys_->is_list(path))
    not_a_list(path, value);
  else if (!keys_->is_key(path))
    add(value.key_place, path, found, unknown_text(value, keys_->meant_by(path)),
        keys_beside(*keys_, path));
}

/// Adds a fault at the first item that is not a table, if the value is an array.
void CaseValues::not_a_list(const std::string& path, const CaseValue& value) {
  const auto item = std::find_if(value.items.begin(), value.items.end(),
                                 [](const CaseValue& v) { return v.type != ValueType::table; });
  const CaseValue& wrong = item == value.items.end() ? value : *item;
  add(wrong.place, path, wrong.type == ValueType::table ? "" : source_.written(wrong.place),
      fmt::format("must be a list of tables, not {}{}", type_word(wrong.type),
                  item == value.items.end() ? "" : " in it"),
      fmt::format("[[{}]] before each table, with {}", path, keys_->keys_in(path + "[]")));
}

bool CaseValues::has_table(std::string_view table) const {
  return source_.tables.contains(table) || source_.values.contains(table);
}

const CaseValue* CaseValues::find(std::string_view key) const {
  const auto found = source_.values.find(key);
  return found == source_.values.end() ? nullptr : &found->second;
}

bool CaseValues::has_array(std::string_view key) const {
  const CaseValue* value = find(key);
  return value && value->type == ValueType::array;
}

std::size_t CaseValues::n_items(std::string_view list) const {
  const auto found = source_.lists.find(list);
  return found == source_.lists.end() ? 0 : found->second;
}

bool CaseValues::good(std::initializer_list<std::string_view> keys) const {
  return std::none_of(keys.begin(), keys.end(),
                      [&](std::string_view key) { return bad_keys_.contains(key); });
}

void CaseValues::add(const Place& place, std::string_view key, std::string found,
                     std::string message, std::string allowed) {
  bad_keys_.emplace(key);
  const std::string& file = source_.sources[at(place.source)].name;
  const bool in_file = place.source == 0;
  faults_.push_back({place,
                     {file, in_file ? place.line : 0, in_file ? place.column : 0, std::string(key),
                      std::move(found), std::move(message), std::move(allowed)}});
}

Place CaseValues::place_of_table(std::string_view table) const {
  for (; !table.empty(); table = table_of(table)) {
    const auto found = source_.tables.find(table);
    if (found != source_.tables.end()) return found->second;
  }
  return {};
}

void CaseValues::bad(const Reading& in, const CaseValue& value, std::string message) {
  add(value.place, in.path, source_.written(value.place), std::move(message),
      keys_->allowed_at(in.path));
}

void CaseValues::wrong_type(const Reading& in, const CaseValue& value, std::string_view asked) {
  bad(in, value,
      fmt::format("must be {}, not {}{}", asked, type_word(value.type), cause_in(value.text)));
}

void CaseValues::fault(std::string_view key, std::string message, std::string allowed) {
  const CaseValue* value = find(key);
  if (!value)
    add(place_of_table(key), key, "", std::move(message), std::move(allowed));
  else
    add(value->place, key, source_.written(value->place), std::move(message), std::move(allowed));
}

void CaseValues::fault_in_file(std::string_view key, Fault fault) {
  const CaseValue* value = find(key);
  bad_keys_.emplace(key);
  faults_.push_back({value ? value->place : place_of_table(key), std::move(fault)});
}

void CaseValues::fault_at_item(std::string_view key, int item, std::string message) {
  const auto found = source_.values.find(key);
  if (key == "ground.profile" && item >= 0 && !profile_lines_.empty()) {
    const int line = profile_lines_[at(item)];
    faults_.push_back({found->second.place,
                       {profile_file_, line, 1, std::string(key), "", std::move(message), ""}});
    return;
  }
  if (found == source_.values.end() || item < 0 ||
      static_cast<std::size_t>(item) >= found->second.items.size())
    return fault(key, std::move(message));
  const Place place = found->second.items[at(item)].place;
  add(place, key, source_.written(place), std::move(message), {});
}

void CaseValues::missing(std::string_view key) {
  bad_keys_.emplace(key);
  std::string_view absent;  // the outermost missing table
  for (std::string_view table = table_of(key); !table.empty(); table = table_of(table)) {
    if (source_.values.contains(table)) return;  // it already has a fault: it is not a table
    if (!source_.tables.contains(table)) absent = table;
  }
  if (absent.empty())
    fault(key, "is missing", keys_->allowed_at(key));
  else
    missing_[std::string(absent)].emplace_back(key);
}

void CaseValues::add_missing_tables() {
  for (const auto& [table, keys] : missing_) {
    std::string list;
    for (const std::string& key : keys) list += (list.empty() ? "" : ", ") + key;
    add(place_of_table(table_of(table)), table, "", "the table is missing; it must give " + list,
        table == "disk" ? "[disk], or [mesh] or [section] with a file in its place" : "");
  }
  missing_.clear();
}

/// Returns the first faults of each key in order, and the number of the others.
std::vector<Fault> CaseValues::first_of_each_key() {
  std::vector<Fault> faults;
  std::map<std::string, std::size_t> counts;
  for (const Located& located : faults_)
    if (++counts[located.fault.key] <= most_faults_of_a_key) faults.push_back(located.fault);
  for (const auto& [key, count] : counts)
    if (count > most_faults_of_a_key)
      faults.push_back({source_.sources[0].name, 0, 0, key, "",
                        fmt::format("and {} more of this kind", count - most_faults_of_a_key), ""});
  return faults;
}

void CaseValues::finish() {
  add_missing_tables();
  const auto order = [](const Located& a) {
    const bool known = a.place.source == 0 && a.place.line > 0;
    return std::tuple(a.place.source, known ? a.place.line : std::numeric_limits<int>::max(),
                      known ? a.place.column : 0);
  };
  std::stable_sort(faults_.begin(), faults_.end(),
                   [&](const Located& a, const Located& b) { return order(a) < order(b); });
  std::vector<Fault> faults = first_of_each_key();
  faults.insert(faults.end(), source_.bad_settings.begin(), source_.bad_settings.end());
  if (!faults.empty()) throw InputError(std::move(faults));
}

bool CaseValues::finite(const Reading& in, const CaseValue& value, double& target) {
  if (value.type != ValueType::number && value.type != ValueType::integer)
    return wrong_type(in, value, "a float"), false;
  if (!std::isfinite(value.number)) return bad(in, value, "must be a finite number"), false;
  target = value.number;
  return true;
}

std::optional<double> CaseValues::number(const Reading& in) {
  double found = 0.0;
  if (!finite(in, in.value, found)) return std::nullopt;
  if (in.allowed.range.contains(found)) return found;
  return bad(in, in.value, "is out of bounds"), std::nullopt;
}

void CaseValues::take(const Reading& in, int& target) {
  const CaseValue& value = in.value;
  if (value.type == ValueType::number)
    return bad(in, value, "must be an integer, not a float: write it without point and exponent");
  if (value.type != ValueType::integer) return wrong_type(in, value, "an integer");
  if (!in.allowed.range.contains(value.number) || value.integer < std::numeric_limits<int>::min() ||
      value.integer > std::numeric_limits<int>::max())
    return bad(in, value, "is out of bounds");
  target = static_cast<int>(value.integer);
}

void CaseValues::take(const Reading& in, bool& target) {
  if (in.value.type != ValueType::boolean) return wrong_type(in, in.value, "a boolean");
  target = in.value.boolean;
}

/// A required text must not be empty; a choice must be one of the allowed words.
std::optional<std::string> CaseValues::text(const Reading& in) {
  if (in.value.type != ValueType::text) return wrong_type(in, in.value, "a string"), std::nullopt;
  if (in.allowed.is_choice() && !find_choice(in.allowed, in.value.text))
    return bad(in, in.value, "is not one of the choices" + cause_in(in.value.text)), std::nullopt;
  if (in.required && in.value.text.empty())
    return fault(in.path, "must not be empty"), std::nullopt;
  return in.value.text;
}

void CaseValues::take(const Reading& in, std::string& target) {
  if (const auto found = text(in)) target = *found;
}

void CaseValues::take(const Reading& in, const Choice& target) {
  if (const auto name = text(in)) target.set(target.target, *find_choice(in.allowed, *name));
}

void CaseValues::take(const Reading& in, const ChoiceList& target) {
  if (in.value.type != ValueType::array) return wrong_type(in, in.value, "an array of strings");
  for (std::size_t i = 0; i < target.among.size() && target.among[i]; ++i) *target.among[i] = false;
  for (const CaseValue& item : in.value.items) {
    const auto found = find_choice(in.allowed, item.text);
    if (item.type != ValueType::text)
      wrong_type(in, item, "a string");
    else if (!found)
      bad(in, item, "is not one of the choices");
    else if (*target.among[*found])
      bad(in, item, "stands there twice");
    else
      *target.among[*found] = true;
  }
}

bool CaseValues::pair(const Reading& in, const CaseValue& value, std::array<double, 2>& target) {
  if (value.type != ValueType::array) return wrong_type(in, value, "a pair of floats"), false;
  if (value.items.size() != 2)
    return bad(in, value,
               fmt::format("must have 2 items, not {}{}", value.items.size(),
                           cause_in_items(source_.written(value.place)))),
           false;
  const bool first = finite(in, value.items[0], target[0]);
  return finite(in, value.items[1], target[1]) && first;
}

/// Empty if any pair is faulty; the first few faults are reported.
std::vector<std::array<double, 2>> CaseValues::pairs(const Reading& in) {
  std::vector<std::array<double, 2>> points;
  std::size_t n_bad = 0;
  for (const CaseValue& item : in.value.items) {
    std::array<double, 2> point{};
    if (pair(in, item, point))
      points.push_back(point);
    else if (++n_bad == most_faults_of_a_key)
      break;
  }
  if (n_bad > 0) points.clear();
  return points;
}

void CaseValues::take(const Reading& in, Vec2& target) {
  std::array<double, 2> components{};
  if (in.value.type != ValueType::array) return wrong_type(in, in.value, "an array");
  if (pair(in, in.value, components)) target = {components[0], components[1]};
}

void CaseValues::take(const Reading& in, Matrix& target) {
  if (in.value.type != ValueType::array) return wrong_type(in, in.value, "an array");
  if (in.value.items.size() != 2)
    return bad(in, in.value, fmt::format("must have 2 rows, not {}", in.value.items.size()));
  const auto rows = pairs(in);
  if (rows.size() == 2) target = {rows[0], rows[1]};
}

void CaseValues::take(const Reading& in, dynamics::Table& target) {
  const CaseValue& value = in.value;
  if (value.type != ValueType::array) {
    double constant = 0.0;
    if (value.type != ValueType::number && value.type != ValueType::integer)
      return wrong_type(in, value, "a float or an array of pairs");
    if (!finite(in, value, constant)) return;
    if (!in.allowed.range.contains(constant)) return bad(in, value, "is out of bounds");
    target = dynamics::Table(constant);
    return;
  }
  if (value.items.empty()) return bad(in, value, "must have at least one point");
  take_points(in, target);
}

void CaseValues::take_points(const Reading& in, dynamics::Table& target) {
  auto points = pairs(in);
  std::size_t n_bad = 0;
  const auto fault = [&](std::size_t i, std::string message) {
    bad(in, in.value.items[i], std::move(message));
    ++n_bad;
  };
  for (std::size_t i = 0; i < points.size() && n_bad < most_faults_of_a_key; ++i) {
    if (i > 0 && points[i][0] <= points[i - 1][0])
      fault(i, fmt::format("the {} must increase, but {} follows {}",
                           in.allowed.of_increments ? "increments" : "times", points[i][0],
                           points[i - 1][0]));
    if (!in.allowed.range.contains(points[i][1])) fault(i, "the value is out of bounds");
  }
  if (!points.empty() && n_bad == 0) target = dynamics::Table(std::move(points));
}

/// Each number once, ascending.
void CaseValues::take(const Reading& in, std::vector<int>& target) {
  if (in.value.type != ValueType::array) return wrong_type(in, in.value, "an array of integers");
  if (in.value.items.empty()) return bad(in, in.value, "must have at least one item");
  target.clear();
  for (const CaseValue& item : in.value.items) {
    int number = 0;
    take({in.allowed, in.required, in.path, item}, number);
    if (number != 0 && std::find(target.begin(), target.end(), number) != target.end())
      bad(in, item, "stands there twice");
    target.push_back(number);
  }
  std::sort(target.begin(), target.end());
}

void CaseValues::take(const Reading& in, std::vector<std::array<double, 2>>& target) {
  if (in.value.type != ValueType::array) return wrong_type(in, in.value, "an array of pairs");
  if (in.value.items.empty() && in.required)
    return bad(in, in.value, "must have at least one pair");
  const auto found = pairs(in);
  if (found.size() == in.value.items.size()) target = found;
}

/// One name, or several; "": none.
void CaseValues::take(const Reading& in, std::vector<std::string>& target) {
  if (in.value.type != ValueType::array) {
    const auto name = text(in);
    if (name) target.assign(name->empty() ? 0 : 1, *name);
    return;
  }
  if (in.value.items.empty() && in.required)
    return bad(in, in.value, "must have at least one name");
  target.clear();
  for (const CaseValue& item : in.value.items) {
    if (item.type != ValueType::text) return wrong_type(in, item, "a string");
    if (item.text.empty()) return bad(in, item, "must not be empty");
    if (std::ranges::find(target, item.text) != target.end())
      return bad(in, item, "stands there twice");
    target.push_back(item.text);
  }
}

/// The path is relative to the case file, like that of the mesh, even if --set gives it.
void CaseValues::take_profile_file(const Reading& in, std::vector<Vec2>& target) {
  const auto folder = std::filesystem::path(source_.sources[0].name).parent_path();
  const std::filesystem::path file = folder / in.value.text;
  try {
    refuse_road(file);
    ProfileFile profile = parse_profile(file.string(), read_input(file, "a profile"));
    for (Fault& fault : profile.faults) faults_.push_back({in.value.place, std::move(fault)});
    if (profile.points.empty()) return static_cast<void>(bad_keys_.emplace(in.path));
    target = std::move(profile.points);
    profile_file_ = file.string();
    profile_lines_ = std::move(profile.lines);
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    add(in.value.place, in.path, source_.written(in.value.place),
        fmt::format("{}: {}{}", fault.file, fault.message, cause_in(in.value.text)),
        fault.allowed.empty() ? keys_->allowed_at(in.path) : fault.allowed);
  }
}

/// The text "flat" leaves the profile unchanged.
void CaseValues::take(const Reading& in, std::vector<Vec2>& target) {
  const CaseValue& value = in.value;
  if (value.type == ValueType::text && value.text == "flat") return;
  if (value.type == ValueType::text) return take_profile_file(in, target);
  if (value.type != ValueType::array) return wrong_type(in, value, "a string or an array of pairs");
  if (value.items.size() < 2) return bad(in, value, "must have at least two points");
  const auto points = pairs(in);
  if (points.empty()) return;
  target.clear();
  for (const auto& [x, y] : points) target.push_back({x, y});
}

void CaseValues::read(const Allowed& allowed, bool required, const std::string& path,
                      const CaseMember& field) {
  const CaseValue* value = find(path);
  if (!value) return;
  const Reading in{allowed, required, path, *value};
  std::visit(
      [&](auto target) {
        using T = decltype(target);
        if constexpr (std::is_same_v<T, Choice> || std::is_same_v<T, ChoiceList>) {
          take(in, target);
        } else if constexpr (std::is_same_v<T, double*> ||
                             std::is_same_v<T, std::optional<double>*>) {
          if (const auto value = number(in)) *target = *value;
        } else if constexpr (std::is_same_v<T, std::filesystem::path*>) {
          if (const auto name = text(in)) *target = *name;
        } else {
          take(in, *target);
        }
      },
      field);
}

std::map<std::string, KeyPlace> CaseValues::places() const {
  std::map<std::string, KeyPlace> places;
  const auto put = [&](const std::string& key, const Place& place, const std::string& written) {
    const bool in_file = place.source == 0;
    places[key] = {source_.sources[at(place.source)].name, in_file ? place.line : 0,
                   in_file ? place.column : 0, written};
  };
  for (const auto& [table, place] : source_.tables) put(table, place, "");
  for (const auto& [key, value] : source_.values) {
    put(key, value.place, source_.written(value.place));
  }
  return places;
}

}  // namespace rondo::study
