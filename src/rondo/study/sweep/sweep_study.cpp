// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/case/toml_text.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/study/sweep/keys/study_keys.hpp"

namespace rondo::study {
namespace {

constexpr TomlShape study_shape{"a study file", is_study_table, is_study_list};

/// The keys allowed beside one, in words.
std::string allowed_beside(std::string_view path) {
  const std::string table = without_indices(table_of(path));
  const bool known = is_study_table(table);
  return fmt::format("{}: {}", known ? "in " + heading_of(table) : "at the top",
                     study_keys_text(known ? table : ""));
}

bool is_known(std::string_view path) {
  return find_study_key(path) != nullptr ||
         without_indices(path) == "vary[].target";  // told by refuse_target()
}

std::string allowed_at(std::string_view path) {
  const StudyKey* key = find_study_key(path);
  RONDO_DEMAND(key != nullptr, path);
  return std::string(key->allowed);
}

/// Reads the values of a study, and gathers all faults.
class Reader {
 public:
  explicit Reader(CaseSource source) : source_(std::move(source)) {
    for (const auto& [path, value] : source_.values)
      if (!is_known(path)) fault(path, "unknown key", allowed_beside(path));
  }

  [[nodiscard]] const CaseValue* find(const std::string& path) const {
    const auto found = source_.values.find(path);
    return found == source_.values.end() ? nullptr : &found->second;
  }
  [[nodiscard]] bool has_table(const std::string& path) const {
    return source_.tables.contains(path);
  }
  [[nodiscard]] std::size_t n_parameters() const {
    const auto found = source_.lists.find("vary");
    return found == source_.lists.end() ? 0 : found->second;
  }
  [[nodiscard]] int line_of(const std::string& path) const {
    const auto found = source_.tables.find(path);
    return found == source_.tables.end() ? 0 : found->second.line;
  }

  void fault(const std::string& path, std::string message) {
    fault(path, std::move(message), allowed_at(path));
  }
  void fault(const std::string& path, std::string message, std::string allowed) {
    const CaseValue* value = find(path);
    Place place = value ? value->place : Place{};
    if (!value) place.line = line_of(path);
    const std::string found =
        value && value->type != ValueType::table ? source_.written(place) : std::string();
    faults_.push_back({source_.sources[0].name, place.line, place.column, path, found,
                       std::move(message), std::move(allowed)});
  }

  /// Null, and a fault, where it is of another type.
  const CaseValue* typed(const std::string& path, ValueType type) {
    const CaseValue* value = find(path);
    if (!value || value->type == type) return value;
    fault(path, fmt::format("must be {}, not {}", type_word(type), type_word(value->type)));
    return nullptr;
  }

  std::string text(const std::string& path) {
    const CaseValue* value = typed(path, ValueType::text);
    if (value && value->text.empty()) fault(path, "is empty");
    return value ? value->text : std::string();
  }

  std::optional<double> number(const std::string& path) {
    const CaseValue* value = find(path);
    if (!value) return std::nullopt;
    const bool right = value->type == ValueType::number || value->type == ValueType::integer;
    if (right && std::isfinite(value->number)) return value->number;
    fault(path, "must be a finite number");
    return std::nullopt;
  }

  std::optional<std::int64_t> integer(const std::string& path, const Range& range) {
    const CaseValue* value = typed(path, ValueType::integer);
    if (!value) return std::nullopt;
    if (range.contains(value->number)) return value->integer;
    fault(path, "is out of bounds");
    return std::nullopt;
  }

  /// `n` finite numbers; null, and a fault, where it is something else.
  const CaseValue* numbers(const std::string& path, std::size_t n) {
    const CaseValue* value = find(path);
    if (!value) return nullptr;
    const auto right = [](const CaseValue& v) {
      return (v.type == ValueType::number || v.type == ValueType::integer) &&
             ends.contains(v.number);
    };
    if (value->type == ValueType::array && value->items.size() == n &&
        std::ranges::all_of(value->items, right))
      return value;
    fault(path, fmt::format("must be {} finite numbers", n));
    return nullptr;
  }

  void finish() {
    std::ranges::stable_sort(faults_, {},
                             [](const Fault& f) { return std::pair(f.line, f.column); });
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }

 private:
  CaseSource source_;
  std::vector<Fault> faults_;
};

void read_top(Reader& in, SweepStudy& study) {
  const CaseValue* schema = in.typed("schema", ValueType::integer);
  if (!in.find("schema")) in.fault("schema", "is missing", "schema = 1");
  if (schema && schema->integer != 1)
    in.fault("schema", "is from another version of rondo; this one reads 1");
  if (!in.find("base"))
    in.fault("base", "is missing", "base = \"case.toml\", relative to the study");
  const std::string base = in.text("base");
  if (!base.empty()) study.base = study.file.parent_path() / base;
  study.title = in.find("title") ? in.text("title") : study.file.stem().string();
  if (const CaseValue* snapshots = in.typed("snapshots", ValueType::boolean))
    study.snapshots = snapshots->boolean;
  const CaseValue* set = in.typed("set", ValueType::array);
  if (!set) return;
  for (const CaseValue& item : set->items) {
    if (item.type == ValueType::text && item.text.find('=') != std::string::npos)
      study.settings.push_back(item.text);
    else
      in.fault("set", "an item is not a setting");
  }
}

/// Values of equal distance, the ends as they are written; integers where all are.
std::vector<std::string> linspace(const CaseValue& of, std::int64_t n) {
  const CaseValue &from = of.items[0], &to = of.items[1];
  constexpr double exact = 0x1p53;  // of the differences below
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

void read_linspace(Reader& in, const std::string& path, Vary& vary) {
  const CaseValue* value = in.numbers(path, 3);
  if (!value) return;
  const CaseValue& n = value->items[2];
  if (n.type != ValueType::integer || !linspace_counts.contains(n.number))
    return in.fault(path, "is an empty range");
  if (value->items[0].number == value->items[1].number)
    return in.fault(path, "both ends are the same", "two different ends, or values = [...]");
  vary.values = linspace(*value, n.integer);
}

void read_uniform(Reader& in, const std::string& path, Vary& vary) {
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

void read_values(Reader& in, const std::string& path, Vary& vary) {
  const CaseValue* value = in.typed(path, ValueType::array);
  if (!value) return;
  if (value->items.empty()) return in.fault(path, "is empty", "at least one value");
  std::set<std::string> seen;
  for (const CaseValue& item : value->items) {
    if (!is_value_of_a_key(item))
      return in.fault(path, "holds what no key of a case file can be",
                      "finite numbers, strings, booleans, and arrays of these");
    vary.values.push_back(toml_text(item));
    const bool number = item.type == ValueType::integer || item.type == ValueType::number;
    if (!seen.insert(number ? fmt::format("{}", item.number) : vary.values.back()).second)
      return in.fault(path, fmt::format("{} stands there twice", vary.values.back()),
                      "each value once");
  }
}

/// Heights and depths of loads were searched for once; now a load is given.
void refuse_target(Reader& in, const std::string& table, const Vary& vary) {
  const std::string path = table + ".target";
  if (!in.find(path)) return;
  in.fault(path, "is known no more: a load is given, and its height follows in the run",
           vary.key == "analysis.depth"
               ? "values of analysis.depth: force_y over depth_m is in history.csv of each crush"
               : "key = \"rim.force_y\" and values = [-1.0e5, ...], N/m, with a base that has "
                 "[rim] with free = [\"height\"]; for a crush values of analysis.depth");
}

void check_key(Reader& in, const std::string& path, const Vary& vary) {
  if (vary.key.empty()) return;
  const std::string meant = meant_text(vary.key);
  if (vary.key.starts_with("output.probe"))
    in.fault(path, "gives the columns of history.csv, which are the same in all members",
             "another key of the case file");
  else if (!may_be_varied(vary.key))
    in.fault(path, "is the same in all members", "another key of the case file");
  else if (find_case_key(vary.key) == nullptr)
    in.fault(path, "is no key of a case file",
             meant.empty() ? "a key, e.g. ground.friction" : meant);
}

Vary read_vary(Reader& in, const std::string& table) {
  Vary vary;
  vary.line = in.line_of(table);
  const std::string key = table + ".key";
  if (!in.find(key)) in.fault(table, "has no key", "key = \"ground.friction\"");
  vary.key = in.text(key);
  check_key(in, key, vary);
  int kinds = 0;
  for (const char* kind : {"values", "linspace", "uniform"})
    kinds += in.find(table + "." + kind) != nullptr ? 1 : 0;
  refuse_target(in, table, vary);
  if (kinds != 1 && !in.find(table + ".target"))
    in.fault(table, kinds == 0 ? "has no values" : "has values twice",
             "one of values, linspace, uniform");
  if (in.find(table + ".values")) read_values(in, table + ".values", vary);
  if (in.find(table + ".linspace")) read_linspace(in, table + ".linspace", vary);
  if (in.find(table + ".uniform")) read_uniform(in, table + ".uniform", vary);
  return vary;
}

void read_parameters(Reader& in, SweepStudy& study) {
  if (in.n_parameters() == 0)
    return in.fault("vary", in.find("vary") ? "must be a list of tables" : "nothing is varied",
                    "[[vary]] with key and values");
  std::set<std::string> seen;
  for (std::size_t k = 0; k < in.n_parameters(); ++k) {
    const std::string table = item_of("vary", k);
    study.parameters.push_back(read_vary(in, table));
    const std::string& key = study.parameters.back().key;
    if (!key.empty() && !seen.insert(key).second)
      in.fault(table + ".key", "is varied twice", "each key once");
  }
}

/// The key that a setting is of.
std::string key_of(const std::string& setting) {
  std::string key = setting.substr(0, setting.find('='));
  std::erase(key, ' ');
  return key;
}

void read_sample(Reader& in, SweepStudy& study) {
  const bool uniform = std::ranges::any_of(
      study.parameters, [](const Vary& vary) { return vary.uniform.has_value(); });
  if (!in.has_table("sample")) {
    if (uniform)
      in.fault("sample", "is missing: a parameter is uniform",
               "[sample] with kind = \"latin-hypercube\", count, seed");
    return;
  }
  if (!uniform)
    in.fault("sample", "samples nothing", "uniform = [from, to] in a [[vary]], or no [sample]");
  const std::string kind = in.text("sample.kind");
  if (in.find("sample.kind") && kind != sample_kind)
    in.fault("sample.kind", "is no kind of sample");
  if (!in.find("sample.count")) in.fault("sample.count", "is missing", "count = 200");
  const auto count = in.integer("sample.count", sample_counts);
  const auto seed = in.integer("sample.seed", sample_seeds);
  if (count)
    study.sample = Sample{static_cast<int>(*count), static_cast<std::uint64_t>(seed.value_or(1))};
}

void read_window(Reader& in, SweepStudy& study) {
  study.window.from = in.number("window.from");
  study.window.to = in.number("window.to");
  if (study.window.from && study.window.to && !(*study.window.from < *study.window.to))
    in.fault("window.to", "is not after window.from", "from < to");
}

SweepStudy read(const std::filesystem::path& file, CaseSource source) {
  Reader in(std::move(source));
  SweepStudy study;
  study.file = file;
  read_top(in, study);
  read_parameters(in, study);
  read_sample(in, study);
  read_window(in, study);
  in.finish();
  check_settings(study);
  return study;
}

}  // namespace

void check_settings(const SweepStudy& study) {
  std::vector<Fault> faults;
  const std::string file = study.file.string();
  const auto is_hidden = [&](const std::string& key) {
    return std::ranges::find(study.parameters, key, &Vary::key) != study.parameters.end();
  };
  for (const std::string& setting : study.settings)
    if (is_hidden(key_of(setting)))
      faults.push_back({file, 0, 0, "", setting, "sets a key that is varied", "another key"});
  const auto is_snapshots = [](const std::string& key) { return key == "output.snapshots"; };
  if (!study.snapshots && (std::ranges::any_of(study.parameters, is_snapshots, &Vary::key) ||
                           std::ranges::any_of(study.settings, is_snapshots, key_of)))
    faults.push_back({file, 0, 0, "output.snapshots", "", "the runs write no snapshots",
                      "snapshots = true at the top of the study"});
  if (!faults.empty()) throw InputError(std::move(faults));
}

SweepStudy read_study(const std::filesystem::path& file) {
  return read(file, load_toml(file, study_shape));
}

SweepStudy read_study_text(const std::filesystem::path& file, std::string text) {
  return read(file, load_toml_text(file.string(), std::move(text), study_shape));
}

}  // namespace rondo::study
