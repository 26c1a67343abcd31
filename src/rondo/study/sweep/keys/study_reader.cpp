// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/keys/study_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

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

bool is_number(const CaseValue& value) {
  return value.type == ValueType::number || value.type == ValueType::integer;
}

}  // namespace

CaseSource load_study(const std::filesystem::path& file) {
  return load_toml(file, study_shape);
}

CaseSource load_study_text(const std::filesystem::path& file, std::string text) {
  return load_toml_text(file.string(), std::move(text), study_shape);
}

StudyReader::StudyReader(CaseSource source) : source_(std::move(source)) {
  for (const auto& [path, value] : source_.values)
    if (!is_known(path)) fault(path, "unknown key", allowed_beside(path));
}

const CaseValue* StudyReader::find(const std::string& path) const {
  const auto found = source_.values.find(path);
  return found == source_.values.end() ? nullptr : &found->second;
}

bool StudyReader::has_table(const std::string& path) const {
  return source_.tables.contains(path);
}

std::size_t StudyReader::n_vary() const {
  const auto found = source_.lists.find("vary");
  return found == source_.lists.end() ? 0 : found->second;
}

int StudyReader::line_of(const std::string& path) const {
  const auto found = source_.tables.find(path);
  return found == source_.tables.end() ? 0 : found->second.line;
}

void StudyReader::fault(const std::string& path, std::string message) {
  fault(path, std::move(message), allowed_at(path));
}

void StudyReader::fault(const std::string& path, std::string message, std::string allowed) {
  const CaseValue* value = find(path);
  Place place = value ? value->place : Place{};
  if (!value) place.line = line_of(path);
  const std::string found =
      value && value->type != ValueType::table ? source_.written(place) : std::string();
  faults_.push_back({source_.sources[0].name, place.line, place.column, path, found,
                     std::move(message), std::move(allowed)});
}

const CaseValue* StudyReader::typed(const std::string& path, ValueType type) {
  const CaseValue* value = find(path);
  if (!value || value->type == type) return value;
  fault(path, fmt::format("must be {}, not {}", type_word(type), type_word(value->type)));
  return nullptr;
}

std::string StudyReader::text(const std::string& path) {
  const CaseValue* value = typed(path, ValueType::text);
  if (value && value->text.empty()) fault(path, "is empty");
  return value ? value->text : std::string();
}

std::vector<std::string> StudyReader::texts(const std::string& path) {
  const CaseValue* value = typed(path, ValueType::array);
  if (!value) return {};
  std::vector<std::string> found;
  for (const CaseValue& item : value->items) {
    if (item.type != ValueType::text || item.text.empty())
      fault(path, "must be an array of strings");
    else if (std::ranges::find(found, item.text) != found.end())
      fault(path, fmt::format("\"{}\" stands there twice", item.text), "each name once");
    else
      found.push_back(item.text);
  }
  return found;
}

std::optional<double> StudyReader::number(const std::string& path) {
  const CaseValue* value = find(path);
  if (!value) return std::nullopt;
  if (is_number(*value) && std::isfinite(value->number)) return value->number;
  fault(path, "must be a finite number");
  return std::nullopt;
}

std::optional<std::int64_t> StudyReader::integer(const std::string& path, const Range& range) {
  const CaseValue* value = typed(path, ValueType::integer);
  if (!value) return std::nullopt;
  if (range.contains(value->number)) return value->integer;
  fault(path, "is out of bounds");
  return std::nullopt;
}

const CaseValue* StudyReader::numbers(const std::string& path, std::size_t n) {
  const CaseValue* value = find(path);
  if (!value) return nullptr;
  const auto right = [](const CaseValue& v) { return is_number(v) && ends.contains(v.number); };
  if (value->type == ValueType::array && value->items.size() == n &&
      std::ranges::all_of(value->items, right))
    return value;
  fault(path, fmt::format("must be {} finite numbers", n));
  return nullptr;
}

void StudyReader::finish() {
  std::ranges::stable_sort(faults_, {}, [](const Fault& f) { return std::pair(f.line, f.column); });
  if (!faults_.empty()) throw InputError(std::move(faults_));
}

}  // namespace rondo::study
