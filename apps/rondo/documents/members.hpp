// SPDX-License-Identifier: BSD-3-Clause
/// @file  The members of a JSON object, a row each: from the rows come the object and its schema.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/case/schema/json_schema.hpp"

namespace rondo::app {

using study::Json;

/// @tparam R  what the object is made from
template <class R>
struct Member {
  std::string_view name;
  std::string_view type;  ///< of JSON: "number" may also be null, which stands for not finite
  std::string_view unit;  ///< "": none
  std::string_view meaning;
  Json (*value)(const R& r);
  Json (*schema)() = nullptr;  ///< of its value, where the type does not say it all
};

template <class R>
Json object_of(std::span<const Member<R>> members, const R& r) {
  Json object = Json::object();
  for (const Member<R>& member : members) object[std::string(member.name)] = member.value(r);
  return object;
}

template <class R, std::size_t N>
Json objects_of(const Member<R> (&members)[N], const std::vector<R>& list) {
  Json array = Json::array();
  for (const R& r : list) array.push_back(object_of(std::span<const Member<R>>(members), r));
  return array;
}

template <class R>
Json schema_of(std::span<const Member<R>> members) {
  Json schema = study::closed_object();
  for (const Member<R>& member : members) {
    Json value = member.schema ? member.schema() : Json{{"type", member.type}};
    if (!member.schema && member.type == "number") value["type"] = {"number", "null"};
    std::string meaning(member.meaning);
    if (!member.unit.empty()) meaning += " [" + std::string(member.unit) + "]";
    value["description"] = meaning;
    schema["properties"][std::string(member.name)] = std::move(value);
    schema["required"].push_back(member.name);
  }
  return schema;
}

template <class R, std::size_t N>
Json schema_of_list(const Member<R> (&members)[N]) {
  return study::array_of(schema_of(std::span<const Member<R>>(members)));
}

inline Json schema_of_texts() {
  return study::array_of(Json{{"type", "string"}});
}

/// Of a type, or null where there is none.
inline Json schema_of_maybe(std::string_view type) {
  return Json{{"type", {type, "null"}}};
}

}  // namespace rondo::app
