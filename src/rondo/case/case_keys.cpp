// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/text/edit_distance.hpp"

namespace rondo::study {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

using enum KeyType;

struct Words {
  std::string_view type, allowed;
};

/// In the order of KeyType; the table of keys gives the allowed range of numbers and choices.
constexpr Words words[] = {
    {"integer", ""},
    {"float", ""},
    {"boolean", "true or false"},
    {"string", "any text"},
    {"string", ""},
    {"array of strings", ""},
    {"float or array of pairs", ""},
    {"string or array of pairs",
     "\"flat\", [[x, y], ...] from left to right, or the name of a CSV file with columns x, y"},
    {"array of 2 floats", "[x, y], finite numbers"},
    {"array of 2 arrays of 2 floats", "[[a, b], [c, d]], finite numbers"},
    {"array of integers", ""},
    {"array of pairs", "[[a, b], ...], finite numbers"},
    {"string or array of strings", "a name, or [\"a\", \"b\", ...]"},
};

const Words& words_of(KeyType type) {
  return words[static_cast<std::size_t>(type)];
}

std::string range_text(const Range& r, bool whole) {
  const bool low = r.low > -unbounded, high = r.high < unbounded;
  if (!low && !high) return whole ? "any integer" : "any finite number";
  if (low && high && r.low == r.high) return fmt::format("{}", r.low);
  if (low && high && !r.low_open && !r.high_open) return fmt::format("{} to {}", r.low, r.high);
  std::string said;
  if (low) said = fmt::format("{} {}", r.low_open ? ">" : ">=", r.low);
  if (high) said += fmt::format("{}{} {}", low ? " and " : "", r.high_open ? "<" : "<=", r.high);
  return said;
}

/// The allowed values of a number or a table.
std::string table_text(const Allowed& allowed, const std::string& range) {
  const char* of_points = allowed.of_increments
                              ? "[[increment, value], ...] with increments increasing"
                              : "[[t, value], ...] with t increasing";
  const std::string said = fmt::format("a finite number or {}", of_points);
  if (!allowed.range.is_bounded()) return said;
  return fmt::format("{}; values {}{}{}", said, range, allowed.also.empty() ? "" : ", ",
                     allowed.also);
}

/// "a" or "b"; "a", "b" or "c".
std::string choices_text(const Allowed& allowed, std::string_view last = " or ") {
  const auto& choices = allowed.choices;
  const auto n = static_cast<std::size_t>(
      std::find(choices.begin(), choices.end(), std::string_view{}) - choices.begin());
  std::string said;
  for (std::size_t i = 0; i < n; ++i)
    said += fmt::format("{}\"{}\"", i == 0 ? "" : i + 1 < n ? ", " : last, choices[i]);
  return said;
}

/// Names of tables and of lists of tables (with "[]"), outer before inner, including tables that
/// contain nothing but tables.
std::vector<std::string_view> table_names() {
  std::vector<std::string_view> tables;
  const auto add = [&](std::string_view table) {
    if (!table.empty() && std::find(tables.begin(), tables.end(), table) == tables.end())
      tables.push_back(table);
  };
  for (const CaseKey& key : case_keys()) {
    add(table_of(table_of(key.path)));
    add(table_of(key.path));
  }
  return tables;
}

bool is_list(std::string_view table) {
  return table.ends_with("[]");
}

/// Whether there is a key that begins with `path` followed by the character `next`.
bool leads_to_a_key(std::string_view path, char next) {
  const auto keys = case_keys();
  return std::any_of(keys.begin(), keys.end(), [&](const CaseKey& key) {
    return key.path.size() > path.size() && key.path.starts_with(path) &&
           key.path[path.size()] == next;
  });
}

/// A case with every part that is possible, with defaults.
Case& whole_case() {
  static Case whole = [] {
    Case c;
    for (const CaseTable& table : case_tables())
      if (table.resize) table.resize(c, 1);
    return c;
  }();
  return whole;
}

struct TypeOf {
  KeyType operator()(const int* /*value*/) const { return integer; }
  KeyType operator()(const double* /*value*/) const { return number; }
  KeyType operator()(const std::optional<double>* /*value*/) const { return number; }
  KeyType operator()(const bool* /*value*/) const { return boolean; }
  KeyType operator()(const std::string* /*value*/) const { return text; }
  KeyType operator()(const std::filesystem::path* /*value*/) const { return text; }
  KeyType operator()(const Choice& /*value*/) const { return choice; }
  KeyType operator()(const ChoiceList& /*value*/) const { return choices; }
  KeyType operator()(const Vec2* /*value*/) const { return vector; }
  KeyType operator()(const Matrix* /*value*/) const { return matrix; }
  KeyType operator()(const dynamics::Table* /*value*/) const { return history; }
  KeyType operator()(const std::vector<Vec2>* /*value*/) const { return profile; }
  KeyType operator()(const std::vector<int>* /*value*/) const { return integers; }
  KeyType operator()(const std::vector<std::array<double, 2>>* /*value*/) const { return pairs; }
  KeyType operator()(const std::vector<std::string>* /*value*/) const { return names; }
};

}  // namespace

bool Range::contains(double value) const noexcept {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

bool Range::is_bounded() const noexcept {
  return low > -unbounded || high < unbounded;
}

std::span<const CaseKey> keys_of(const CaseTable& table) {
  const auto keys = case_keys();
  const auto is_of = [&](const CaseKey& key) { return table_of(key.path) == table.path; };
  const auto first = std::find_if(keys.begin(), keys.end(), is_of);
  return {first, std::find_if_not(first, keys.end(), is_of)};
}

const CaseTable& table_with(const CaseKey& key) {
  const auto tables = case_tables();
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const CaseTable& table) {
    return table.path == table_of(key.path);
  });
  RONDO_DEMAND(found != tables.end(), key.path);
  return *found;
}

bool means_to(const CaseKey& key, AnalysisKind kind) {
  return key.use.analyses.contain(kind) && table_with(key).analyses.contain(kind);
}

const CaseKey* find_case_key(std::string_view path) {
  const std::string any_item = without_indices(path);
  for (const CaseKey& key : case_keys())
    if (key.path == any_item) return &key;
  return nullptr;
}

bool is_case_table(std::string_view path) {
  return leads_to_a_key(without_indices(path), '.');
}

bool is_case_list(std::string_view path) {
  return leads_to_a_key(without_indices(path), '[');
}

std::string item_of(std::string_view list, std::size_t index) {
  return fmt::format("{}[{}]", list, index);
}

std::string without_indices(std::string_view path) {
  std::string without;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) without += c;
    if (c == '[') inside = true;
  }
  return without;
}

std::string heading_of(std::string_view table) {
  if (!is_list(table)) return fmt::format("[{}]", table);
  return fmt::format("[[{}]]", table.substr(0, table.size() - 2));
}

std::string path_of(const CaseKey& key, std::size_t index) {
  const auto item = key.path.find("[]");
  if (item == std::string_view::npos) return std::string(key.path);
  return item_of(key.path.substr(0, item), index) + std::string(key.path.substr(item + 2));
}

void reset(const CaseKey& key, Case& c) {
  const CaseTable& table = table_with(key);
  if (table.is_list()) return table.resize(c, 0);
  if (table.count(c) == 0) return;
  std::visit(
      [&](auto from) {
        const auto to = std::get<decltype(from)>(key.field(c, 0));
        if constexpr (std::is_same_v<decltype(from), Choice>)
          to.set(to.target, from.get(from.target));
        else if constexpr (std::is_same_v<decltype(from), ChoiceList>)
          for (std::size_t i = 0; i < from.among.size() && from.among[i]; ++i)
            *to.among[i] = *from.among[i];
        else
          *to = *from;
      },
      key.field(whole_case(), 0));
}

KeyType type_of(const CaseKey& key) {
  const KeyType type = std::visit(TypeOf{}, key.field(whole_case(), 0));
  return type == text && key.allowed.is_choice() ? choice : type;
}

std::optional<std::size_t> find_choice(const Allowed& allowed, std::string_view name) {
  const auto found = std::find(allowed.choices.begin(), allowed.choices.end(), name);
  if (name.empty() || found == allowed.choices.end()) return std::nullopt;
  return static_cast<std::size_t>(found - allowed.choices.begin());
}

std::string default_text(const CaseKey& key) {
  if (!key.use.standard.empty()) return std::string(key.use.standard);
  return key.use.required ? "required" : value_text(key, key.field(whole_case(), 0));
}

std::string_view type_text(const CaseKey& key) {
  return words_of(type_of(key)).type;
}

std::string allowed_text(const CaseKey& key) {
  const KeyType type = type_of(key);
  const std::string_view also = key.allowed.also;
  if (type == choice) return choices_text(key.allowed);
  if (type == choices) return fmt::format("[], or any of {}", choices_text(key.allowed, ", "));
  const std::string range = range_text(key.allowed.range, type == integer);
  if (type == history) return table_text(key.allowed, range);
  if (type == integers)
    return fmt::format("[i, ...], each {}", range_text(key.allowed.range, true));
  if (type != integer && type != number)
    return std::string(words_of(type).allowed) + (also.empty() ? "" : "; ") + std::string(also);
  if (also.empty()) return range;
  return range + (also.starts_with("<") ? " and " : "; ") + std::string(also);
}

std::string keys_text(std::string_view table) {
  const std::string any_item = without_indices(table);
  std::string said;
  const auto add = [&](std::string_view word) {
    said += (said.empty() ? "" : ", ") + std::string(word);
  };
  for (const CaseKey& key : case_keys())
    if (table_of(key.path) == any_item) add(leaf_of(key.path));
  for (const std::string_view inner : table_names())
    if (table_of(inner) == any_item) add(heading_of(inner));
  return said;
}

std::string_view table_of(std::string_view path) noexcept {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
}

std::string_view leaf_of(std::string_view path) noexcept {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

std::string_view nearest_key(std::string_view path) {
  constexpr std::size_t longest = 60;  // no key is half as long
  const std::string any_item = without_indices(path);
  const std::string_view leaf = leaf_of(any_item), table = table_of(any_item);
  if (leaf.size() > longest || table.size() > longest) return {};
  std::string_view best;
  std::pair<std::size_t, std::size_t> least{std::max<std::size_t>(1, leaf.size() / 3) + 1, 0};
  const auto consider = [&](std::string_view candidate) {
    const std::pair score{edit_distance(leaf, leaf_of(candidate)),
                          edit_distance(table, table_of(candidate))};
    // A short name in another table counts as similar only if it is equal.
    if (table != table_of(candidate) && score.first > leaf.size() / 4) return;
    if (score >= least) return;
    least = score;
    best = candidate;
  };
  for (const CaseKey& key : case_keys()) consider(key.path);
  for (const std::string_view inner : table_names())
    consider(is_list(inner) ? inner.substr(0, inner.size() - 2) : inner);
  return best;
}

std::string meant_text(std::string_view path) {
  const std::string any_item = without_indices(path);
  std::string meant{nearest_key(path)};
  for (const Synonym& synonym : synonyms_of_keys()) {
    if (synonym.word != leaf_of(any_item)) continue;
    if (synonym.key.empty()) return std::string(synonym.instead);
    const std::string here = fmt::format("{}.{}", table_of(any_item), leaf_of(synonym.key));
    meant = find_case_key(here) != nullptr ? here : std::string(synonym.key);
  }
  return meant.empty() ? meant : fmt::format("did you mean {}?", meant);
}

}  // namespace rondo::study
