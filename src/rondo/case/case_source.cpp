// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_source.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/numbers/foreign_writing.hpp"
#include "rondo/case/toml_text.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

constexpr std::size_t largest_file = 16'000'000;  ///< bytes
constexpr TomlShape case_shape{"a case file", is_case_table, is_case_list};
constexpr std::size_t longest_found = 60;  ///< characters of a value quoted in a message

Fault file_fault(const std::string& name, std::string message, std::string allowed = {}) {
  return {name, 0, 0, "", "", std::move(message), std::move(allowed)};
}

/// A chain of dotted keys becomes equally many nested tables, into which the parser recurses.
bool nested_too_deeply(std::string_view text) {
  int dots = 0;
  bool comment = false;
  for (const char c : text) {
    if (c == '\n' || c == ',' || c == '=' || c == '[' || c == '{') dots = 0;
    if (c == '\n') comment = false;
    if (c == '#') comment = true;
    if (c == '.' && !comment && ++dots > 250) return true;
  }
  return false;
}

}  // namespace

std::string read_input(const std::filesystem::path& file, std::string_view what) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(file_fault(name, "there is no such file"));
  if (const std::string kind = kind_of_no_file(file); !kind.empty())
    throw InputError(file_fault(name, fmt::format("is {}, not {}", kind, what),
                                "a regular file: what a pipe gives is to be written into one"));
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError(file_fault(name, std::string("cannot be read: ") + std::strerror(errno)));
  std::string text;
  std::array<char, 65536> part{};
  do {
    in.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  } while (in && text.size() <= largest_file);
  if (in.bad()) throw InputError(file_fault(name, "cannot be read"));
  if (text.size() > largest_file)
    throw InputError(
        file_fault(name, fmt::format("is longer than {} may be", what), "at most 16 MB"));
  return text;
}

namespace {

std::string read_text(const std::filesystem::path& file, std::string_view what) {
  const std::string name = file.string();
  std::string text = read_input(file, what);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(file_fault(name, "the file is empty", fmt::format("{} in TOML", what)));
  if (text.find('\0') != std::string::npos)
    throw InputError(file_fault(name, "is not a text file: it holds NUL bytes",
                                fmt::format("{} in TOML", what)));
  if (nested_too_deeply(text))
    throw InputError(
        file_fault(name, "has keys nested more than 250 deep", fmt::format("{} in TOML", what)));
  return text;
}

SourceText source_text(std::string name, std::string text) {
  SourceText source{std::move(name), std::move(text), {0}};
  for (std::size_t i = 0; i < source.text.size(); ++i)
    if (source.text[i] == '\n') source.line_begin.push_back(i + 1);
  return source;
}

std::string_view line_of(const SourceText& source, int line) {
  const auto at = static_cast<std::size_t>(line - 1);
  if (line < 1 || at >= source.line_begin.size()) return {};
  const std::string_view rest = std::string_view(source.text).substr(source.line_begin[at]);
  return rest.substr(0, rest.find('\n'));
}

Place place_of(const toml::source_region& region, int source) {
  return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column),
          static_cast<int>(region.end.line), static_cast<int>(region.end.column)};
}

CaseValue value_of(const toml::node& node, int source) {
  CaseValue value;
  value.place = place_of(node.source(), source);
  if (const auto* text = node.as_string()) {
    value.type = ValueType::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.type = ValueType::integer;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.type = ValueType::number;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.type = ValueType::boolean;
    value.boolean = boolean->get();
  } else if (const auto* array = node.as_array()) {
    value.type = ValueType::array;
    value.items.reserve(array->size());
    for (const toml::node& item : *array) value.items.push_back(value_of(item, source));
  } else if (!node.is_table()) {
    value.type = ValueType::date;
  }
  return value;
}

bool is_bare(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

std::string joined(const std::string& table, std::string_view key) {
  const std::string part = is_bare(key) ? std::string(key) : toml_string(key);
  return table.empty() ? part : table + "." + part;
}

/// Where tables are opened: the target, the kind of file, the source.
struct Opening {
  CaseSource& into;
  const TomlShape& shape;
  int source = 0;
};

void add_table(const Opening& in, const std::string& path, const toml::table& table);

/// Opens a list of tables of a case; a value of another type in its place is not a list.
bool add_list(const Opening& in, const std::string& path, const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!in.shape.is_list(path) || list == nullptr) return false;
  for (const toml::node& item : *list)
    if (!item.is_table()) return false;
  in.into.lists[path] = list->size();
  for (std::size_t k = 0; k < list->size(); ++k) {
    const std::string inner = item_of(path, k);
    in.into.tables[inner] = place_of((*list)[k].source(), in.source);
    add_table(in, inner, *(*list)[k].as_table());
  }
  return true;
}

/// Opens a table of a case; any other table is a value, which the reader will refuse.
void add_table(const Opening& in, const std::string& path, const toml::table& table) {
  for (const auto& [key, node] : table) {
    const std::string inner = joined(path, key.str());
    if (node.is_table() && in.shape.is_table(inner)) {
      in.into.tables[inner] = place_of(node.source(), in.source);
      add_table(in, inner, *node.as_table());
      continue;
    }
    if (add_list(in, inner, node)) continue;
    CaseValue value = value_of(node, in.source);
    value.key_place = place_of(key.source(), in.source);
    in.into.values[inner] = std::move(value);
  }
}

/// Removes a key and all keys below it.
void remove(CaseSource& from, const std::string& path) {
  const auto at_or_below = [&](const auto& entry) {
    return entry.first == path || entry.first.starts_with(path + ".") ||
           entry.first.starts_with(path + "[");
  };
  std::erase_if(from.values, at_or_below);
  std::erase_if(from.tables, at_or_below);
  std::erase_if(from.lists, at_or_below);
}

/// A setting of the ground's shape replaces another one, and the places on a road that go with it.
void remove_rivals_of_ground(CaseSource& from, std::string_view path) {
  if (path != "ground.profile" && path != "ground.road") return;
  std::erase_if(from.values, [&](const auto& entry) {
    const std::string_view key = entry.first;
    const bool rival =
        path == "ground.road" ? key == "ground.profile" : key.starts_with("ground.road");
    return rival && entry.second.place.source == 0;
  });
}

/// A setting of one key of the table of friction makes a number in its place the coefficient.
void open_friction(CaseSource& from, std::string_view path) {
  const std::string table = "ground.friction";
  const auto number = from.values.find(table);
  if (!path.starts_with(table + ".") || number == from.values.end()) return;
  from.tables[table] = number->second.place;
  from.values[table + ".coefficient"] = number->second;
  from.values.erase(table);
}

/// A setting of one of several exclusive keys replaces the others in the file.
void remove_rivals(CaseSource& from, std::string_view path) {
  static const std::vector<std::string_view> step{"time.step", "time.safety"},
      height{"motion.height", "analysis.load"},
      speed{"motion.speed", "analysis.traction", "analysis.torque"};
  const auto kind = from.values.find("analysis.kind");
  const bool steady = kind != from.values.end() && kind->second.text == "steady-rolling";
  for (const auto* keys : {&step, &height, &speed})
    if (std::ranges::find(*keys, path) != keys->end() && (steady || keys == &step))
      std::erase_if(from.values, [&](const auto& entry) {
        return entry.first != path && entry.second.place.source == 0 &&
               std::ranges::find(*keys, entry.first) != keys->end();
      });
}

/// Removes the other key for the change of volume of a material, which only one key may give.
void remove_rival_of_volume(CaseSource& from, std::string_view path) {
  const std::string_view table = table_of(path), leaf = leaf_of(path);
  if (without_indices(table) != "material" && without_indices(table) != "material.region[]") return;
  for (const auto& [one, other] :
       {std::pair("bulk_modulus", "poissons_ratio"), std::pair("poissons_ratio", "bulk_modulus")})
    if (leaf == one) {
      const auto rival = from.values.find(fmt::format("{}.{}", table, other));
      if (rival != from.values.end() && rival->second.place.source == 0) from.values.erase(rival);
    }
}

/// "v = TEXT" as a table with the key v; if TEXT is not TOML, it is taken as a string.
toml::table parsed_setting(const std::string& text) {
  if (!nested_too_deeply(text)) {
    try {
      toml::table parsed = toml::parse("v = " + text);
      if (parsed.size() == 1) return parsed;
    } catch (const toml::parse_error&) {  // not TOML: it is a string
    }
  }
  return toml::parse("v = " + toml_string(as_utf8(text)));
}

/// "name" for "name[3]"; the part itself if it has no index.
std::string_view without_index(std::string_view part) {
  const auto begin = part.find('[');
  if (begin == std::string_view::npos || !part.ends_with(']')) return part;
  const std::string_view digits = part.substr(begin + 1, part.size() - begin - 2);
  const bool number =
      !digits.empty() && digits.size() <= 9 && (digits == "0" || digits.front() != '0') &&
      std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number ? part.substr(0, begin) : part;
}

bool is_dotted_key(std::string_view path) {
  constexpr std::size_t longest = 1000;  // no key is a tenth as long
  if (path.size() > longest) return false;
  while (true) {
    const auto dot = path.find('.');
    if (!is_bare(without_index(path.substr(0, dot)))) return false;
    if (dot == std::string_view::npos) return true;
    path.remove_prefix(dot + 1);
  }
}

/// Finds the table of a list that a setting names: an existing one, or the one after the last.
/// False: the setting is invalid.
bool find_items(CaseSource& into, const std::string& path, const std::string& name) {
  for (auto end = path.find(']'); end != std::string::npos; end = path.find(']', end + 1)) {
    const auto begin = path.rfind('[', end);
    const std::string list = path.substr(0, begin);
    const std::size_t index = std::stoul(path.substr(begin + 1, end - begin - 1));
    if (!is_case_list(list)) return true;  // an unknown key
    std::size_t& count = into.lists[list];
    if (index > count) {
      into.bad_settings.push_back(
          file_fault(name, fmt::format("there are {} tables in {}, from number 0 on", count, list),
                     fmt::format("{}[{}] adds one", list, count)));
      return false;
    }
    count = std::max(count, index + 1);
  }
  return true;
}

void apply_setting(CaseSource& into, const std::string& setting) {
  const int source = static_cast<int>(into.sources.size());
  const std::string name = "--set " + setting;
  const auto equals = setting.find('=');
  std::string path = setting.substr(0, equals);
  path.erase(0, std::min(path.size(), path.find_first_not_of(' ')));
  path.erase(path.find_last_not_of(' ') + 1);
  if (equals == std::string::npos || !is_dotted_key(path)) {
    into.bad_settings.push_back(file_fault(name, "is not a setting", "a.b=value"));
    return;
  }
  if (!find_items(into, path, name)) return;
  const std::string text = setting.substr(equals + 1);
  into.sources.push_back(source_text(name, "v = " + text));
  const toml::table parsed = parsed_setting(text);
  open_friction(into, path);
  remove(into, path);
  remove_rivals(into, path);
  remove_rivals_of_ground(into, path);
  remove_rival_of_volume(into, path);
  Place place;
  place.source = source;
  for (auto dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1))
    if (is_case_table(path.substr(0, dot))) into.tables.try_emplace(path.substr(0, dot), place);
  const toml::node& node = *parsed.get("v");
  if (node.is_table() && is_case_table(path)) {
    into.tables[path] = place;
    add_table({into, case_shape, source}, path, *node.as_table());
    return;
  }
  if (add_list({into, case_shape, source}, path, node)) return;
  CaseValue value = value_of(node, source);
  value.key_place = place;
  into.values[path] = std::move(value);
}

}  // namespace

CaseSource load_toml(const std::filesystem::path& file, const TomlShape& shape) {
  return load_toml_text(file.string(), read_text(file, shape.what), shape);
}

CaseSource load_toml_text(const std::string& name, std::string text, const TomlShape& shape) {
  CaseSource source;
  source.sources.push_back(source_text(name, std::move(text)));
  try {
    add_table({source, shape}, "", toml::parse(source.sources[0].text));
  } catch (const toml::parse_error& error) {
    const Place at = place_of(error.source(), 0);
    const std::string cause = foreign_writing_in_line(line_of(source.sources[0], at.line));
    throw InputError(Fault{
        name, at.line, at.column, "", "",
        fmt::format("is not TOML: {}{}{}", error.description(), cause.empty() ? "" : "; ", cause),
        ""});
  }
  return source;
}

CaseSource load_case(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  return load_case_text(file.string(), read_text(file, case_shape.what), settings);
}

CaseSource load_case_text(const std::string& name, std::string text,
                          const std::vector<std::string>& settings) {
  CaseSource source = load_toml_text(name, std::move(text), case_shape);
  for (const std::string& setting : settings) apply_setting(source, setting);
  return source;
}

std::string CaseSource::written(const Place& place) const {
  const SourceText& source = sources[at(place.source)];
  const auto offset = [&](int line, int column) {
    const auto at = static_cast<std::size_t>(line - 1);
    if (line < 1 || at >= source.line_begin.size()) return source.text.size();
    std::size_t i = source.line_begin[at];
    for (int c = 1; c < column && i < source.text.size(); ++c)  // columns are counted in characters
      while (++i < source.text.size() && (static_cast<unsigned char>(source.text[i]) >> 6) == 2) {
      }
    return i;
  };
  const std::size_t begin = offset(place.line, place.column);
  const std::size_t end = std::max(begin, offset(place.end_line, place.end_column));
  std::string found;
  for (std::size_t i = begin; i < end; ++i) {
    const char c = source.text[i];
    const bool space = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (found.size() >= longest_found && (static_cast<unsigned char>(c) >> 6) != 2)
      return found + "...";
    if (!space)
      found += c;
    else if (!found.empty() && found.back() != ' ')
      found += ' ';
  }
  return found;
}

std::string as_utf8(std::string text) {
  try {
    if (!toml::parse("v = " + toml_string(text)).empty()) return text;
  } catch (const toml::parse_error&) {
    for (char& c : text)
      if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  }
  return text;
}

std::string toml_text(const CaseValue& value) {
  switch (value.type) {
    case ValueType::text:
      return toml_string(value.text);
    case ValueType::integer:
      return fmt::format("{}", value.integer);
    case ValueType::boolean:
      return value.boolean ? "true" : "false";
    case ValueType::number:
      return toml_number(value.number);
    case ValueType::array: {
      std::string text;
      for (const CaseValue& item : value.items)
        text += (text.empty() ? "" : ", ") + toml_text(item);
      return "[" + text + "]";
    }
    case ValueType::date:
    case ValueType::table:
      break;
  }
  RONDO_DEMAND(false, type_word(value.type));
  return {};
}

std::string_view type_word(ValueType type) noexcept {
  switch (type) {
    case ValueType::text:
      return "a string";
    case ValueType::integer:
      return "an integer";
    case ValueType::number:
      return "a float";
    case ValueType::boolean:
      return "a boolean";
    case ValueType::date:
      return "a date or time";
    case ValueType::array:
      return "an array";
    case ValueType::table:
      return "a table";
  }
  return "";
}

}  // namespace rondo::study
