// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/schema/case_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace rondo::study {
namespace {

const Range any_number{};

Json number_in(const Range& range) {
  return bounded("number", range);
}

Json pair_in(const Range& second) {
  return tuple_of({number_in(any_number), number_in(second)});
}

Json any_of(Json one, Json other) {
  return Json{{"anyOf", Json::array({std::move(one), std::move(other)})}};
}

Json text_of(const CaseKey& key) {
  Json text{{"type", "string"}};
  if (key.use.required) text["minLength"] = 1;
  return text;
}

Json without_repeats(Json array) {
  array["uniqueItems"] = true;
  return array;
}

/// The schema of a value by its type alone.
Json value_schema(const CaseKey& key) {
  const Range& range = key.allowed.range;
  switch (type_of(key)) {
    case KeyType::integer:
      return bounded("integer", range);
    case KeyType::number:
      return number_in(range);
    case KeyType::boolean:
      return Json{{"type", "boolean"}};
    case KeyType::text:
      return text_of(key);
    case KeyType::choice:
      return one_of(key.allowed.choices);
    case KeyType::choices:
      return without_repeats(array_of(one_of(key.allowed.choices)));
    case KeyType::history:
      return any_of(number_in(range), array_of(pair_in(range), 1));
    case KeyType::profile:
      return any_of(text_of(key), array_of(pair_in(any_number), 2));
    case KeyType::vector:
      return pair_in(any_number);
    case KeyType::matrix:
      return tuple_of({pair_in(any_number), pair_in(any_number)});
    case KeyType::integers:
      return without_repeats(array_of(bounded("integer", range), 1));
    case KeyType::pairs:
      return array_of(pair_in(any_number), key.use.required ? 1 : 0);
    case KeyType::names:
      return any_of(text_of(key),
                    without_repeats(array_of(Json{{"type", "string"}, {"minLength", 1}},
                                             key.use.required ? 1 : 0)));
  }
  return {};
}

std::string description_of(const CaseKey& key) {
  std::string text = without_links(key.meaning) + "\n\n";
  if (key.unit != "-") text += fmt::format("Unit: {}. ", key.unit);
  return text + fmt::format("Allowed: {}. Default: {}.", allowed_text(key), default_text(key));
}

/// Null: the key has no default, or its default is described in words.
Json default_of(const CaseKey& key) {
  if (key.use.required || !key.use.standard.empty()) return {};
  const TomlShape flat{"a default", [](std::string_view) { return false; },
                       [](std::string_view) { return false; }};
  const std::string text = "v = " + default_text(key);
  return json_of(load_toml_text(std::string(key.path), text, flat).values.at("v"));
}

/// The analyses that require the key when its table exists.
unsigned kinds_that_require(const CaseKey& key) {
  const bool plain = key.use.when == static_cast<Use::Test>(always) &&
                     key.use.of_item == static_cast<Use::TestOfItem>(always);
  if (!key.use.required || !plain) return 0;
  return key.use.required_in.bits & key.use.analyses.bits & table_with(key).analyses.bits;
}

bool is_always_required(const CaseKey& key) {
  return kinds_that_require(key) == ~0U;
}

bool is_body(const CaseTable& table) {
  return std::ranges::find(body_tables, table.path) != body_tables.end();
}

/// A table in the place of a value of the same path requires its keys where it is there.
bool is_alternative(const CaseTable& table) {
  return find_case_key(table.path) != nullptr;
}

/// Adds the keys of the table, and its subtables that always exist, if they are required.
void add_required(Json& schema, const CaseTable& table) {
  Json required = Json::array();
  for (const CaseKey& key : keys_of(table))
    if (is_always_required(key) || (key.use.required && is_alternative(table)))
      required.push_back(leaf_of(key.path));
  if (required.empty()) return;
  table_in(schema, table.path)["required"] = std::move(required);
  if (table.resize != nullptr || table.path.empty() || is_body(table) || is_alternative(table))
    return;
  Json& outer = table_in(schema, table_of(table.path));
  outer["required"].push_back(leaf_of(table.path));
}

/// Matches a case that requests one of these kinds of analysis.
Json kind_among(unsigned kinds) {
  Json given = presence_of("analysis.kind"), names = Json::array();
  const bool standard = ((kinds >> static_cast<unsigned>(Case{}.analysis.kind)) & 1U) != 0;
  for (std::size_t k = 0; k < std::size(analysis_kinds); ++k)
    if ((((kinds >> k) & 1U) != 0) != standard) names.push_back(analysis_kinds[k].name);
  given["properties"]["analysis"]["properties"]["kind"]["enum"] = std::move(names);
  return standard ? Json{{"not", given}} : given;
}

std::string names_of_kinds(unsigned kinds) {
  std::string text;
  for (std::size_t k = 0; k < std::size(analysis_kinds); ++k)
    if (((kinds >> k) & 1U) != 0)
      text += fmt::format("{}\"{}\"", text.empty() ? "" : " or ", analysis_kinds[k].name);
  return text;
}

Json all_of(std::vector<Json> conditions) {
  return Json{{"allOf", std::move(conditions)}};
}

/// The rule of a key that some kinds require. In an optional table it applies if the table exists,
/// in a list to each of its tables.
Json rule_that_requires(const CaseKey& key, unsigned kinds) {
  std::vector<Json> conditions{kind_among(kinds), Json{{"not", presence_of(key.path)}}};
  const CaseTable& table = table_with(key);
  if (table.resize != nullptr && !table.is_list()) conditions.push_back(presence_of(table.path));
  return refuse(
      fmt::format("{} is missing: analysis.kind = {} requires it", key.path, names_of_kinds(kinds)),
      all_of(std::move(conditions)));
}

/// Adds what some analyses require, and what is refused because only other analyses use it.
void add_rules_of_analyses(Json& rules) {
  std::map<unsigned, std::pair<std::string, Json>> of_others;
  for (const CaseKey& key : case_keys()) {
    const unsigned kinds = kinds_that_require(key);
    if (kinds != 0 && kinds != ~0U) rules.push_back(rule_that_requires(key, kinds));
    if (means_to(key, AnalysisKind::dynamic)) continue;
    auto& [names, given] = of_others[key.use.analyses.bits & table_with(key).analyses.bits];
    names += (names.empty() ? "" : ", ") + std::string(key.path);
    given["anyOf"].push_back(presence_of(key.path));
  }
  for (const auto& [kinds, keys] : of_others)
    rules.push_back(
        refuse(fmt::format("{}: only with analysis.kind = {}", keys.first, names_of_kinds(kinds)),
               all_of({kind_among(~kinds), keys.second})));
}

void add_rules_of_bodies(Json& rules) {
  Json one_at_least;
  for (const std::string_view body : body_tables) {
    one_at_least["anyOf"].push_back(presence_of(body));
    for (const std::string_view other : body_tables)
      if (body < other)
        rules.push_back(
            refuse(fmt::format("[{}] beside [{}]: the body is one or the other", body, other),
                   Json{{"required", {body, other}}}));
  }
  rules.push_back(refuse("the body is missing: [disk], or [mesh] or [section] in its place",
                         Json{{"not", one_at_least}}));
}

void add_rules_of_ground(Json& rules) {
  const Json profile = presence_of("ground.profile"), road = presence_of("ground.road");
  rules.push_back(refuse("ground.profile beside ground.road: the ground has one shape",
                         all_of({profile, road})));
  rules.push_back(
      refuse("ground.profile is missing, or ground.road in its place",
             all_of({presence_of("ground"), Json{{"not", profile}}, Json{{"not", road}}})));
}

}  // namespace

Json schema_of(const CaseKey& key) {
  Json schema = value_schema(key);
  schema["description"] = description_of(key);
  if (schema.contains("anyOf"))  // an editor shows that of the selected alternative
    for (Json& one : schema["anyOf"]) one["description"] = schema["description"];
  if (Json standard = default_of(key); !standard.is_null()) schema["default"] = std::move(standard);
  if (is_case_table(
          key.path)) {  // bounds of numbers and members of tables do not disturb each other
    schema["type"] = {schema["type"], "object"};
    schema["additionalProperties"] = closed_object()["additionalProperties"];
  }
  return schema;
}

Json case_schema() {
  Json schema = schema_head("A case file of rondo",
                            "Written by `rondo schema case` from the program's table of keys. What "
                            "stands between keys beyond this, `rondo check` tells.");
  schema.update(closed_object());
  for (const CaseTable& table : case_tables()) {
    Json& into = table_in(schema, table.path);
    if (!table.path.empty() && !is_alternative(table))
      into["description"] = fmt::format("{}: {}", heading_of(table.path), keys_text(table.path));
    for (const CaseKey& key : keys_of(table))
      into["properties"][std::string(leaf_of(key.path))] = schema_of(key);
    add_required(schema, table);
  }
  Json& rules = schema["allOf"] = Json::array();
  add_rules_of_bodies(rules);
  add_rules_of_ground(rules);
  add_rules_of_analyses(rules);
  return schema;
}

}  // namespace rondo::study
