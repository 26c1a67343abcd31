// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/keys/study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace rondo::study {
namespace {

Json text() {
  return Json{{"type", "string"}, {"minLength", 1}};
}

Json number() {
  return bounded("number", Range{});
}

/// The name of a key of the case file; tables in lists are given by their number.
Json name_of_key() {
  Json names = Json::array();
  std::string items;
  for (const CaseKey& key : case_keys()) {
    if (!may_be_varied(key.path)) continue;
    const auto list = key.path.find("[]");
    if (list == std::string_view::npos) {
      names.push_back(key.path);
      continue;
    }
    items += fmt::format("{}{}\\[[0-9]+\\]{}", items.empty() ? "" : "|", key.path.substr(0, list),
                         key.path.substr(list + 2));
  }
  Json one;
  one["anyOf"] = {Json{{"type", "string"}, {"enum", names}},
                  Json{{"type", "string"}, {"pattern", "^(" + items + ")$"}}};
  return one;
}

Json values() {
  Json array = array_of(Json{{"type", {"number", "string", "boolean", "array"}}}, 1);
  array["uniqueItems"] = true;
  return array;
}

Json names_of_keys() {
  Json array = array_of(name_of_key(), 2);
  array["uniqueItems"] = true;
  return array;
}

Json texts() {
  Json array = array_of(text());
  array["uniqueItems"] = true;
  return array;
}

Json linspace() {
  return tuple_of(
      {bounded("number", ends), bounded("number", ends), bounded("integer", linspace_counts)});
}

Json uniform() {
  return tuple_of({bounded("number", ends), bounded("number", ends)});
}

constexpr StudyKey keys[] = {
    {"schema", "1", "required", "Version of the study file's format",
     [] {
       return bounded("integer", {1.0, 1.0, false, false});
     }},
    {"title", "any text", "name of the study file", "Title of the study, for people", text},
    {"base", "a case file, relative to the study", "required", "Case that all runs begin with",
     text},
    {"set", "[\"a.b=value\", ...]", "[]", "Keys of the case, set to the same values for all runs",
     [] {
       return array_of(Json{{"type", "string"}, {"pattern", "="}});
     }},
    {"snapshots", "true or false", "false",
     "Whether each run writes the snapshots of the base case",
     [] {
       return Json{{"type", "boolean"}};
     }},
    {"columns", "[\"NAME\", ...], columns of history.csv", "[]",
     "Columns of history.csv for which the table also has NAME_mean, NAME_min, NAME_max and "
     "NAME_last, over the window",
     texts},
    {"vary[].key", "a key of a case file, e.g. ground.friction", "none",
     "Key that is varied. Each table gives one of key and keys", name_of_key},
    {"vary[].keys", "[\"key\", ...], two keys of a case file and more", "none",
     "Keys that are varied together", names_of_keys},
    {"vary[].values", "[value, ...]; beside keys [[value, ...], ...]", "none",
     "Values of the key; with keys, a list for each run, with a value for each key. Each table "
     "gives one of values, linspace and uniform",
     values},
    {"vary[].linspace", "[from, to, n], n an integer of at least 2", "none",
     "Range and number of values at equal distances; whole numbers if all of them are", linspace},
    {"vary[].uniform", "[from, to], from < to", "none",
     "Range in which the values are sampled, as [sample] says", uniform},
    {"sample.kind", "\"latin-hypercube\"", "\"latin-hypercube\"",
     "Method that draws the points of the sample",
     [] {
       return one_of({&sample_kind, 1});
     }},
    {"sample.count", "an integer from 1 to 1000000", "required", "Number of points of the sample",
     [] { return bounded("integer", sample_counts); }},
    {"sample.seed", "an integer from 0 on", "1",
     "Seed of the sample; the same seed gives the same points",
     [] { return bounded("integer", sample_seeds); }},
    {"window.from", "a time, s", "the second half of the run",
     "Beginning of the part of each run over which means and peaks are taken; unit: s", number},
    {"window.to", "a time, s", "the end of the run",
     "End of the part of each run over which means and peaks are taken; unit: s", number},
};

constexpr std::string_view tables[] = {"vary[]", "sample", "window"};

}  // namespace

std::span<const StudyKey> study_keys() noexcept {
  return keys;
}

const StudyKey* find_study_key(std::string_view path) {
  const auto found = std::ranges::find(keys, without_indices(path), &StudyKey::path);
  return found == std::end(keys) ? nullptr : &*found;
}

bool is_study_table(std::string_view path) {
  return std::ranges::find(tables, without_indices(path)) != std::end(tables);
}

bool is_study_list(std::string_view path) {
  return std::ranges::find(tables, std::string(path) + "[]") != std::end(tables);
}

std::string study_keys_text(std::string_view table) {
  std::string said;
  const auto add = [&](std::string_view word) {
    said += (said.empty() ? "" : ", ") + std::string(word);
  };
  for (const StudyKey& key : keys)
    if (table_of(key.path) == table) add(leaf_of(key.path));
  if (table.empty())
    for (const std::string_view inner : tables) add(heading_of(inner));
  return said;
}

bool may_be_varied(std::string_view key) {
  return key != "schema" && key != "title" && key != "analysis.kind" &&
         !key.starts_with("output.probe");
}

Json study_schema() {
  Json schema = schema_head("A study file of rondo",
                            "Written by `rondo schema study`. What the varied keys may be, "
                            "`rondo sweep --dry-run` tells.");
  schema.update(closed_object());
  for (const StudyKey& key : keys) {
    Json& table = table_in(schema, table_of(key.path));
    Json value = key.schema();
    value["description"] =
        fmt::format("{}\n\nAllowed: {}. Default: {}.", key.meaning, key.allowed, key.standard);
    table["properties"][std::string(leaf_of(key.path))] = std::move(value);
    if (key.standard == "required") table["required"].push_back(leaf_of(key.path));
  }
  schema["required"].push_back("vary");
  schema["properties"]["vary"]["minItems"] = 1;
  Json one_key, several;
  one_key.update(presence_of("key"));
  one_key["not"] = presence_of("keys");
  for (const char* kind : {"values", "linspace", "uniform"})
    one_key["oneOf"].push_back(presence_of(kind));
  several["required"] = {"keys", "values"};
  for (const char* other : {"key", "linspace", "uniform"})
    several["not"]["anyOf"].push_back(presence_of(other));
  several["properties"]["values"] = array_of(array_of(Json::object(), 2), 1);
  Json& vary = table_in(schema, "vary[]");
  for (Json& way : std::array{one_key, several}) vary["oneOf"].push_back(std::move(way));
  return schema;
}

}  // namespace rondo::study
