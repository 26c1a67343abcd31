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

bool is_known(std::string_view path) {
  return find_study_key(path) != nullptr ||
         without_indices(path) == "vary[].target";  // refuse_target() reports it
}

std::string allowed_at(std::string_view path) {
  const StudyKey* key = find_study_key(path);
  RONDO_DEMAND(key != nullptr, path);
  return std::string(key->allowed);
}

std::string keys_in(std::string_view table) {
  return study_keys_text(without_indices(table));
}

std::string nothing_meant(std::string_view /*path*/) {
  return {};
}

constexpr KeysOfFile keys_of_study{is_known, is_study_table, is_study_list,
                                   keys_in,  allowed_at,     nothing_meant};

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

StudyReader::StudyReader(CaseSource source) : CaseValues(std::move(source), keys_of_study) {}

void StudyReader::fault(std::string_view path, std::string message) {
  fault(path, std::move(message), allowed_at(path));
}

const CaseValue* StudyReader::typed(const std::string& path, ValueType type) {
  const CaseValue* value = find(path);
  if (!value || value->type == type) return value;
  fault(path, fmt::format("must be {}, not {}", type_word(type), type_word(value->type)));
  return nullptr;
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

}  // namespace rondo::study
