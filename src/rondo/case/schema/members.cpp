// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/schema/members.hpp"

namespace rondo::study {
namespace {

Json schema_of_type(std::string_view type) {
  constexpr std::string_view array = "array of ", object = "object of ", null = " or null";
  if (type.starts_with(array)) return array_of(schema_of_type(type.substr(array.size())));
  if (type.starts_with(object))
    return {{"type", "object"}, {"additionalProperties", {{"type", type.substr(object.size())}}}};
  if (type.ends_with(null)) return {{"type", {type.substr(0, type.size() - null.size()), "null"}}};
  if (type == "number") return {{"type", {"number", "null"}}};
  return {{"type", type}};
}

Json schema_of_value(const MemberText& member, bool required) {
  if (member.parts.empty()) return schema_of_type(member.type);
  Json parts = schema_of(member.parts, required);
  if (member.type == "array") return array_of(std::move(parts));
  if (member.type == "object or null") parts["type"] = {"object", "null"};
  return parts;
}

void add_paths(const std::string& before, std::span<const MemberText> members,
               std::vector<std::pair<std::string, MemberText>>& paths) {
  for (const MemberText& member : members) {
    const std::string path = before + std::string(member.name);
    paths.emplace_back(path, member);
    add_paths(path + (member.type == "array" ? "[]." : "."), member.parts, paths);
  }
}

}  // namespace

std::vector<MemberText> joined(std::vector<std::vector<MemberText>> lists) {
  std::vector<MemberText> all;
  for (std::vector<MemberText>& list : lists)
    for (MemberText& member : list) all.push_back(std::move(member));
  return all;
}

std::vector<std::pair<std::string, MemberText>> paths_of(std::span<const MemberText> members) {
  std::vector<std::pair<std::string, MemberText>> paths;
  add_paths("", members, paths);
  return paths;
}

Json schema_of(std::span<const MemberText> members, bool required) {
  Json schema = closed_object();
  for (const MemberText& member : members) {
    Json value = schema_of_value(member, required);
    std::string meaning = without_links(member.meaning);
    if (!member.unit.empty()) meaning += " [" + std::string(member.unit) + "]";
    value["description"] = meaning;
    schema["properties"][std::string(member.name)] = std::move(value);
    if (required) schema["required"].push_back(member.name);
  }
  return schema;
}

}  // namespace rondo::study
