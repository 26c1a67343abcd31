// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/simulation/drive.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "rondo/case/case_keys.hpp"

namespace rondo::study {
namespace {

using dynamics::Table;

/// The motion's table of what is free gives the value at t = 0 alone.
bool counts_at_start_alone(const Case& c, const std::string& path) {
  if (!c.rim) return false;
  return (path == "motion.speed" && c.rim->free_x) || (path == "motion.height" && c.rim->free_y) ||
         (path == "motion.angular_velocity" && c.rim->free_spin);
}

/// The table of the k-th table of its list; null: it is none in time, or means nothing to the case.
Table* table_in_time(Case& c, const CaseKey& key, std::size_t k) {
  if (key.allowed.of_increments || !means_to(key, c.analysis.kind) || !counts(key, c, k) ||
      counts_at_start_alone(c, path_of(key, k)))
    return nullptr;
  const CaseMember field = key.field(c, k);
  Table* const* table = std::get_if<Table*>(&field);
  return table ? *table : nullptr;
}

std::size_t how_many(const CaseTable& of, const Case& c) {
  return of.is_list() ? of.count(c) : std::min<std::size_t>(of.count(c), 1);
}

/// "load.pressure[2].value" to 2; of no list 0.
std::size_t index_in(std::string_view path) {
  const std::size_t open = path.find('[');
  std::size_t index = 0;
  if (open != std::string_view::npos)
    std::from_chars(path.data() + open + 1, path.data() + path.size(), index);
  return index;
}

InputError wrong_key(const Case& c, const std::string& key) {
  const std::vector<std::string> keys = driven_keys(c);
  const CaseKey* known = find_case_key(key);
  const std::string meant = known ? "" : meant_text(key);
  const std::string why =
      !known ? fmt::format("there is no such key{}{}", meant.empty() ? "" : ": ", meant)
      : type_of(*known) == KeyType::history ? "has no effect on this case after its start"
                                            : "stays what it is while the case runs";
  return InputError(Fault{"", 0, 0, key, "", why,
                          keys.empty() ? "none: no key of this case is a table in time"
                                       : fmt::format("{}", fmt::join(keys, ", "))});
}

struct Driven {
  const CaseKey* key = nullptr;
  Table* table = nullptr;
};

Driven find(Case& c, const std::string& path) {
  const CaseKey* key = find_case_key(path);
  const std::size_t k = index_in(path);
  Table* table = key && k < how_many(table_with(*key), c) ? table_in_time(c, *key, k) : nullptr;
  if (!table) throw wrong_key(c, path);
  return {key, table};
}

}  // namespace

std::vector<std::string> driven_keys(const Case& c) {
  Case copy = c;
  std::vector<std::string> keys;
  for (const CaseTable& of : case_tables())
    for (const CaseKey& key : keys_of(of))
      for (std::size_t k = 0; k < how_many(of, c); ++k)
        if (table_in_time(copy, key, k)) keys.push_back(path_of(key, k));
  return keys;
}

Table led_over(const Table& table, double from, double to, double value) {
  std::vector<std::array<double, 2>> points;
  for (const auto& point : table.points())
    if (point[0] < from) points.push_back(point);
  points.push_back({from, table.at(from)});
  points.push_back({to, value});
  return Table(std::move(points));
}

Table& driven_table(Case& c, const std::string& key) {
  return *find(c, key).table;
}

Table& driven_table(Case& c, const std::string& key, double value) {
  const Driven found = find(c, key);
  if (std::isfinite(value) && found.key->allowed.range.contains(value)) return *found.table;
  throw InputError(Fault{"", 0, 0, key, fmt::format("{}", value), "is not allowed",
                         std::isfinite(value) ? allowed_text(*found.key) : "a finite number"});
}

}  // namespace rondo::study
