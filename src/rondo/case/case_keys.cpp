// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "rondo/core/edit_distance.hpp"

namespace rondo::study {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using enum KeyType;

std::string range_text(const Range& r, bool whole) {
  const bool low = r.low > -infinity, high = r.high < infinity;
  if (!low && !high) return whole ? "any integer" : "any finite number";
  if (low && high && r.low == r.high) return fmt::format("{}", r.low);
  if (low && high && !r.low_open && !r.high_open) return fmt::format("{} to {}", r.low, r.high);
  std::string said;
  if (low) said = fmt::format("{} {}", r.low_open ? ">" : ">=", r.low);
  if (high) said += fmt::format("{}{} {}", low ? " and " : "", r.high_open ? "<" : "<=", r.high);
  return said;
}

/// "a" or "b"; "a", "b" or "c".
std::string choices_text(const CaseKey& key) {
  const auto n = static_cast<std::size_t>(
      std::count_if(key.choices.begin(), key.choices.end(),
                    [](std::string_view choice) { return !choice.empty(); }));
  std::string said;
  for (std::size_t i = 0; i < n; ++i)
    said += fmt::format("{}\"{}\"", i == 0 ? "" : i + 1 < n ? ", " : " or ", key.choices[i]);
  return said;
}

/// Names of tables and of lists of tables, these with "[]", outer before inner.
std::vector<std::string_view> case_tables() {
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

/// There is a key of which `path` is the part before a character `next`.
bool leads_to_a_key(std::string_view path, char next) {
  const auto keys = case_keys();
  return std::any_of(keys.begin(), keys.end(), [&](const CaseKey& key) {
    return key.path.size() > path.size() && key.path.starts_with(path) &&
           key.path[path.size()] == next;
  });
}

}  // namespace

bool Range::contains(double value) const noexcept {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
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

std::string_view type_text(const CaseKey& key) noexcept {
  switch (key.type) {
    case integer:
      return "integer";
    case number:
      return "float";
    case boolean:
      return "boolean";
    case text:
    case choice:
      return "string";
    case history:
      return "float or array of pairs";
    case profile:
      return "string or array of pairs";
    case vector:
      return "array of 2 floats";
    case matrix:
      return "array of 2 arrays of 2 floats";
  }
  return "";
}

std::string allowed_text(const CaseKey& key) {
  std::string said;
  switch (key.type) {
    case integer:
    case number:
      said = range_text(key.range, key.type == integer);
      break;
    case boolean:
      return "true or false";
    case text:
      return "any text";
    case choice:
      return choices_text(key);
    case history:
      return "a finite number or [[t, value], ...] with t increasing";
    case profile:
      return "\"flat\" or [[x, y], ...] from left to right";
    case vector:
      return "[x, y], finite numbers";
    case matrix:
      return "[[a, b], [c, d]], finite numbers";
  }
  if (key.also.empty()) return said;
  return said + (key.also.starts_with("<") ? " and " : "; ") + std::string(key.also);
}

std::string keys_text(std::string_view table) {
  const std::string any_item = without_indices(table);
  std::string said;
  const auto add = [&](std::string_view word) {
    said += (said.empty() ? "" : ", ") + std::string(word);
  };
  for (const CaseKey& key : case_keys())
    if (table_of(key.path) == any_item) add(leaf_of(key.path));
  for (const std::string_view inner : case_tables()) {
    if (table_of(inner) != any_item) continue;
    if (is_list(inner))
      add(fmt::format("[[{}]]", inner.substr(0, inner.size() - 2)));
    else
      add(fmt::format("[{}]", inner));
  }
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
    // A short name in another table is near only if it is the same.
    if (table != table_of(candidate) && score.first > leaf.size() / 4) return;
    if (score >= least) return;
    least = score;
    best = candidate;
  };
  for (const CaseKey& key : case_keys()) consider(key.path);
  for (const std::string_view inner : case_tables())
    consider(is_list(inner) ? inner.substr(0, inner.size() - 2) : inner);
  return best;
}

}  // namespace rondo::study
