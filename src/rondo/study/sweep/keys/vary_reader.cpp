// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/keys/vary_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "rondo/case/toml_text.hpp"
#include "rondo/study/sweep/keys/study_keys.hpp"

namespace rondo::study {
namespace {

/// Equally spaced values; the ends are as written. All values are integers if possible.
std::vector<std::string> linspace(const CaseValue& of, std::int64_t n) {
  const CaseValue &from = of.items[0], &to = of.items[1];
  constexpr double exact = 0x1p53;  // limit for the differences below
  const bool whole = from.type == ValueType::integer && to.type == ValueType::integer &&
                     std::abs(from.number) < exact && std::abs(to.number) < exact &&
                     (to.integer - from.integer) % (n - 1) == 0;
  std::vector<std::string> values;
  for (std::int64_t k = 0; k < n; ++k) {
    const double inner = from.number + (to.number - from.number) * static_cast<double>(k) /
                                           static_cast<double>(n - 1);
    const double value = k == n - 1 ? to.number : inner;
    values.push_back(
        whole ? fmt::format("{}", from.integer + (to.integer - from.integer) / (n - 1) * k)
              : toml_number(value));
  }
  return values;
}

void read_linspace(StudyReader& in, const std::string& path, Vary& vary) {
  const CaseValue* value = in.numbers(path, 3);
  if (!value) return;
  const CaseValue& n = value->items[2];
  if (n.type != ValueType::integer || !linspace_counts.contains(n.number))
    return in.fault(path, "is an empty range");
  if (value->items[0].number == value->items[1].number)
    return in.fault(path, "both ends are the same", "two different ends, or values = [...]");
  vary.values = linspace(*value, n.integer);
}

void read_uniform(StudyReader& in, const std::string& path, Vary& vary) {
  const CaseValue* value = in.numbers(path, 2);
  if (!value) return;
  if (!(value->items[0].number < value->items[1].number))
    return in.fault(path, "is an empty range");
  const CaseKey* key = find_case_key(vary.key);
  if (key && type_of(*key) == KeyType::integer &&
      (value->items[0].type != ValueType::integer || value->items[1].type != ValueType::integer))
    return in.fault(path, "samples an integer key between ends that are not whole",
                    "[from, to], integers");
  vary.uniform = {value->items[0].number, value->items[1].number};
}

bool is_value_of_a_key(const CaseValue& value) {
  if (value.type == ValueType::table || value.type == ValueType::date) return false;
  return std::isfinite(value.number) && std::ranges::all_of(value.items, is_value_of_a_key);
}

constexpr const char* what_a_key_can_be = "finite numbers, strings, booleans, and arrays of these";

/// A text that is equal for equal values, such as 1 and 1.0.
std::string identity(const CaseValue& value) {
  const bool number = value.type == ValueType::integer || value.type == ValueType::number;
  return number ? fmt::format("{}", value.number) : toml_text(value);
}

/// The items of an array; if it is empty or another type, none, and a fault.
std::vector<CaseValue> items_of(StudyReader& in, const std::string& path) {
  const CaseValue* value = in.typed(path, ValueType::array);
  if (!value) return {};
  if (value->items.empty()) in.fault(path, "is empty", "at least one value");
  return value->items;
}

void read_values(StudyReader& in, const std::string& path, Vary& vary) {
  std::set<std::string> seen;
  for (const CaseValue& item : items_of(in, path)) {
    if (!is_value_of_a_key(item))
      return in.fault(path, "holds what no key of a case file can be", what_a_key_can_be);
    vary.values.push_back(toml_text(item));
    if (!seen.insert(identity(item)).second)
      return in.fault(path, fmt::format("{} stands there twice", vary.values.back()),
                      "each value once");
  }
}

/// Earlier versions searched for heights and depths of given loads; now a load itself is given.
void refuse_target(StudyReader& in, const std::string& table, const Vary& vary) {
  const std::string path = table + ".target";
  if (!in.has(path)) return;
  in.fault(path, "is known no more: a load is given, and its height follows in the run",
           vary.key == "analysis.depth"
               ? "values of analysis.depth: force_y over depth_m is in history.csv of each crush"
               : "key = \"rim.force_y\" and values = [-1.0e5, ...], N/m, with a base that has "
                 "[rim] with free = [\"height\"]; for a crush values of analysis.depth");
}

/// @param who  subject of the message about the key; empty: the key is that at the path
void check_key(StudyReader& in, const std::string& path, const std::string& key,
               const std::string& who) {
  if (key.empty()) return;
  const std::string meant = meant_text(key);
  if (key.starts_with("output.probe"))
    in.fault(path, who + "gives the columns of history.csv, which are the same in all members",
             "another key of the case file");
  else if (!may_be_varied(key))
    in.fault(path, who + "is the same in all members", "another key of the case file");
  else if (find_case_key(key) == nullptr)
    in.fault(path, who + "is no key of a case file" + (meant.empty() ? "" : "; " + meant),
             "a key, e.g. ground.friction");
}

constexpr std::array kinds{"values", "linspace", "uniform"};

Vary read_one(StudyReader& in, const std::string& table) {
  Vary vary;
  vary.line = in.line_of(table);
  const std::string key = table + ".key";
  if (!in.has(key))
    in.fault(table, "has no key", "key = \"ground.friction\", or keys = [...] of several");
  in.read(key, &vary.key);
  check_key(in, key, vary.key, "");
  const auto n =
      std::ranges::count_if(kinds, [&](const char* kind) { return in.has(table + "." + kind); });
  refuse_target(in, table, vary);
  if (n != 1 && !in.has(table + ".target"))
    in.fault(table, n == 0 ? "has no values" : "has values twice",
             "one of values, linspace, uniform");
  if (in.has(table + ".values")) read_values(in, table + ".values", vary);
  if (in.has(table + ".linspace")) read_linspace(in, table + ".linspace", vary);
  if (in.has(table + ".uniform")) read_uniform(in, table + ".uniform", vary);
  return vary;
}

/// The values of keys in one [[vary]]: for each run, a list with one value per key.
void read_rows(StudyReader& in, const std::string& path, std::span<Vary> together) {
  std::set<std::string> seen;
  for (const CaseValue& row : items_of(in, path)) {
    if (row.type != ValueType::array || row.items.size() != together.size())
      return in.fault(
          path,
          fmt::format("{} is not a value for each of the {} keys", toml_text(row), together.size()),
          "values = [[value, ...], ...], in each list a value for each key, in the "
          "order of keys");
    std::string all;
    for (std::size_t k = 0; k < together.size(); ++k) {
      if (!is_value_of_a_key(row.items[k]))
        return in.fault(path, "holds what no key of a case file can be", what_a_key_can_be);
      together[k].values.push_back(toml_text(row.items[k]));
      all += identity(row.items[k]) + '\n';
    }
    if (!seen.insert(all).second)
      return in.fault(path, fmt::format("{} stands there twice", toml_text(row)), "each list once");
  }
}

/// Reads several keys whose values are combined.
std::vector<Vary> read_together(StudyReader& in, const std::string& table) {
  const std::string path = table + ".keys";
  std::vector<Vary> together;
  for (const std::string& key : in.texts(path)) {
    Vary& vary = together.emplace_back();
    vary.key = key;
    vary.line = in.line_of(table);
    vary.goes_with_previous = together.size() > 1;
    check_key(in, path, key, fmt::format("\"{}\" ", key));
  }
  if (in.has(table + ".key"))
    in.fault(table + ".key", "stands beside keys", "key of one, or keys of several");
  if (together.size() < 2)
    in.fault(path, "are fewer than two", "two keys and more whose values go together; else key");
  for (const char* kind : {"linspace", "uniform", "target"})
    if (in.has(table + "." + kind))
      in.fault(table + "." + kind, "is of one key", "values = [[value, ...], ...] beside keys");
  if (!in.has(table + ".values"))
    in.fault(table, "has no values", "values = [[value, ...], ...], a value for each key");
  else if (together.size() > 1)
    read_rows(in, table + ".values", together);
  return together;
}

}  // namespace

std::vector<Vary> read_parameters(StudyReader& in) {
  std::vector<Vary> parameters;
  if (in.n_items("vary") == 0 && !in.has("vary"))
    in.fault("vary", "nothing is varied", "[[vary]] with key and values");
  std::set<std::string> seen;
  for (std::size_t k = 0; k < in.n_items("vary"); ++k) {
    const std::string table = item_of("vary", k);
    const bool several = in.has(table + ".keys");
    for (Vary& vary : several ? read_together(in, table) : std::vector{read_one(in, table)}) {
      if (!vary.key.empty() && !seen.insert(vary.key).second)
        in.fault(table + (several ? ".keys" : ".key"),
                 several ? vary.key + " is varied twice" : "is varied twice", "each key once");
      parameters.push_back(std::move(vary));
    }
  }
  return parameters;
}

}  // namespace rondo::study
