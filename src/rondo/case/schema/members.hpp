// SPDX-License-Identifier: BSD-3-Clause
/// @file  The members of a JSON object, a row each: from the rows come the object, its schema, and
/// the tables of the manual and of the Python package.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "rondo/case/schema/json_schema.hpp"

namespace rondo::study {

/// A member without its value.
struct MemberText {
  std::string_view name;
  /// Type in JSON: "string", "integer or null", "array of string", "object of string". A "number"
  /// may always be null, which stands for one that is not finite.
  std::string_view type;
  std::string_view unit;               ///< of a plane body, see unit_of(); "": none
  std::string_view meaning;            ///< in Markdown
  std::vector<MemberText> parts = {};  ///< of the object, or of each object in the array
};

/// @tparam R  what the object is made from
template <class R>
struct JsonMember {
  std::string_view name, type, unit, meaning;  ///< as in MemberText
  Json (*value)(const R& r);                   ///< absent(): this object has no such member
  std::vector<MemberText> (*parts)() = nullptr;
};

inline Json absent() {
  return Json(Json::value_t::discarded);
}

template <class R, std::size_t N>
void add_members(const JsonMember<R> (&members)[N], const std::type_identity_t<R>& r,
                 Json& object) {
  for (const JsonMember<R>& member : members)
    if (Json value = member.value(r); !value.is_discarded())
      object[std::string(member.name)] = std::move(value);
}

template <class R, std::size_t N>
Json object_of(const JsonMember<R> (&members)[N], const std::type_identity_t<R>& r) {
  Json object = Json::object();
  add_members(members, r, object);
  return object;
}

template <class R, std::size_t N>
Json objects_of(const JsonMember<R> (&members)[N], std::span<const std::type_identity_t<R>> list) {
  Json array = Json::array();
  for (const R& r : list) array.push_back(object_of(members, r));
  return array;
}

template <class R, std::size_t N>
std::vector<MemberText> texts_of(const JsonMember<R> (&members)[N]) {
  std::vector<MemberText> texts;
  for (const auto& [name, type, unit, meaning, value, parts] : members)
    texts.push_back({name, type, unit, meaning, parts ? parts() : std::vector<MemberText>()});
  return texts;
}

/// All of several lists, in their order.
std::vector<MemberText> joined(std::vector<std::vector<MemberText>> lists);

/// Every member with its path, "contact.nodes_max" or "regions[].name", each before its parts.
std::vector<std::pair<std::string, MemberText>> paths_of(std::span<const MemberText> members);

/// An object that has nothing else. @param required each of them is in every such object
Json schema_of(std::span<const MemberText> members, bool required = true);

}  // namespace rondo::study
