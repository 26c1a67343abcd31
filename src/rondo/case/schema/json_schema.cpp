// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/schema/json_schema.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

Json number_of(std::string_view type, double value) {
  return type == "integer" ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

}  // namespace

Json schema_head(std::string_view title, std::string_view description) {
  Json schema;
  schema["$schema"] = "http://json-schema.org/draft-04/schema#";
  schema["title"] = title;
  schema["description"] = description;
  return schema;
}

Json closed_object() {
  Json object;
  object["type"] = "object";
  object["properties"] = Json::object();
  object["additionalProperties"] = refuse("an unknown key", Json::object());
  return object;
}

Json array_of(Json item, std::size_t n_least) {
  Json array;
  array["type"] = "array";
  array["items"] = std::move(item);
  if (n_least > 0) array["minItems"] = n_least;
  return array;
}

Json tuple_of(std::vector<Json> items) {
  Json array;
  array["type"] = "array";
  array["minItems"] = items.size();
  array["maxItems"] = items.size();
  array["items"] = std::move(items);
  return array;
}

Json bounded(std::string_view type, const Range& range) {
  Json number;
  number["type"] = type;
  if (range.low == range.high) {
    number["enum"] = Json::array({number_of(type, range.low)});
    return number;
  }
  if (std::isfinite(range.low)) number["minimum"] = number_of(type, range.low);
  if (range.low_open) number["exclusiveMinimum"] = true;
  if (std::isfinite(range.high)) number["maximum"] = number_of(type, range.high);
  if (range.high_open) number["exclusiveMaximum"] = true;
  return number;
}

Json one_of(std::span<const std::string_view> words) {
  Json text;
  text["type"] = "string";
  text["enum"] = Json::array();
  for (const std::string_view word : words)
    if (!word.empty()) text["enum"].push_back(word);
  return text;
}

Json refuse(std::string_view reason, const Json& what) {
  Json refused;
  refused["description"] = reason;
  refused.update(what);
  return Json{{"not", refused}};
}

Json presence_of(std::string_view path) {
  const auto dot = path.find('.');
  const std::string_view first = path.substr(0, dot);
  const std::string_view rest = dot == std::string_view::npos ? "" : path.substr(dot + 1);
  Json schema;
  if (first.ends_with("[]")) {
    schema["properties"][std::string(first.substr(0, first.size() - 2))]["items"] =
        presence_of(rest);
    return schema;
  }
  if (rest.find("[]") == std::string_view::npos) schema["required"] = {first};
  if (!rest.empty()) schema["properties"][std::string(first)] = presence_of(rest);
  return schema;
}

Json& table_in(Json& schema, std::string_view path) {
  if (path.empty()) return schema;
  const auto dot = path.find('.');
  std::string_view part = path.substr(0, dot);
  const bool list = part.ends_with("[]");
  if (list) part.remove_suffix(2);
  Json& here = schema["properties"][std::string(part)];
  if (here.is_null()) here = list ? array_of(closed_object()) : closed_object();
  Json& table = list ? here["items"] : here;
  return dot == std::string_view::npos ? table : table_in(table, path.substr(dot + 1));
}

Json json_of(const CaseValue& value) {
  switch (value.type) {
    case ValueType::text:
      return value.text;
    case ValueType::integer:
      return value.integer;
    case ValueType::number:
      return value.number;
    case ValueType::boolean:
      return value.boolean;
    case ValueType::array: {
      Json array = Json::array();
      for (const CaseValue& item : value.items) array.push_back(json_of(item));
      return array;
    }
    case ValueType::date:
    case ValueType::table:
      break;
  }
  RONDO_DEMAND(false, type_word(value.type));
  return {};
}

std::string without_links(std::string_view markdown) {
  std::string text(markdown);
  for (auto middle = text.find("]("); middle != std::string::npos; middle = text.find("](")) {
    const auto begin = text.rfind('[', middle);
    const auto end = text.find(')', middle);
    RONDO_DEMAND(begin != std::string::npos && end != std::string::npos, text);
    text.erase(middle, end + 1 - middle);
    text.erase(begin, 1);
  }
  return text;
}

}  // namespace rondo::study
