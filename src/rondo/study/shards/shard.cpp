// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/shards/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <tuple>

#include "rondo/core/error.hpp"
#include "rondo/study/sweep/sweep_study.hpp"

namespace rondo::study {
namespace {

/// Accepts only digits. Returns false if it is not a number.
bool read_number(std::string_view text, std::size_t& number) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

bool read_pair(std::string_view text, std::string_view between, Shard& shard) {
  const std::size_t at = text.find(between);
  return at != std::string_view::npos && read_number(text.substr(0, at), shard.number) &&
         read_number(text.substr(at + between.size()), shard.count) && shard.number >= 1 &&
         shard.number <= shard.count && shard.count <= most_members;
}

/// Sort key of a member in the row that is cut into shards.
struct ShardPlace {
  std::size_t body_turn = 0, body = 0;  ///< bodies are distributed to the shards
  std::size_t turn = 0, number = 0;     ///< a body's members to its shards
};

/// Bodies are numbered in the order of their first members.
std::vector<ShardPlace> places_of(const std::vector<PlannedMember>& members, std::size_t shards) {
  std::map<std::string_view, std::size_t> numbers;
  std::vector<std::size_t> body, size;
  for (const PlannedMember& member : members) {
    const auto [found, is_new] = numbers.try_emplace(member.body, numbers.size());
    if (is_new) size.push_back(0);
    body.push_back(found->second);
    ++size[found->second];
  }
  std::vector<std::size_t> seen(size.size(), 0);
  std::vector<ShardPlace> places;
  for (const std::size_t b : body) {
    const std::size_t pieces = (size[b] * shards + members.size() - 1) / members.size();
    const std::size_t k = seen[b]++;
    places.push_back({b % shards, b, k % pieces, k});
  }
  return places;
}

}  // namespace

Shard shard_of(const std::string& text) {
  Shard shard;
  if (read_pair(text, "/", shard)) return shard;
  throw request_error("--shard", text, "is no part of a sweep",
                      fmt::format("i/n, whole numbers, 1 <= i <= n <= {}: of 8 parts 1/8, 2/8, to "
                                  "8/8",
                                  most_members));
}

std::string text_of(const Shard& shard) {
  return fmt::format("{}/{}", shard.number, shard.count);
}

std::string folder_name(const Shard& shard) {
  const std::size_t digits = std::max<std::size_t>(4, fmt::formatted_size("{}", shard.count));
  return fmt::format("{:0{}}-of-{:0{}}", shard.number, digits, shard.count, digits);
}

bool shard_of_folder(const std::string& name, Shard& shard) {
  return read_pair(name, "-of-", shard) && folder_name(shard) == name;
}

std::vector<std::size_t> divide(const std::vector<PlannedMember>& members, std::size_t shards) {
  const std::vector<ShardPlace> places = places_of(members, shards);
  std::vector<std::size_t> order(members.size());
  for (std::size_t m = 0; m < order.size(); ++m) order[m] = m;
  std::ranges::sort(order, {}, [&](std::size_t m) {
    const ShardPlace& p = places[m];
    return std::tuple(p.body_turn, p.body, p.turn, p.number);
  });
  std::vector<std::size_t> shard(members.size());
  const std::size_t each = members.size() / shards, more = members.size() % shards;
  std::size_t next = 0;
  for (std::size_t s = 0; s < shards && next < order.size(); ++s)
    for (std::size_t k = 0; k < each + (s < more ? 1 : 0); ++k) shard[order[next++]] = s + 1;
  return shard;
}

void choose_members(std::vector<PlannedMember>& members, const Shard& shard) {
  const std::vector<std::size_t> shards = divide(members, shard.count);
  for (std::size_t m = 0; m < members.size(); ++m)
    members[m].part = shards[m] == shard.number ? Part::own : Part::other;
  for (const PlannedMember& member : members)
    if (member.part == Part::own && member.modes_of && members[*member.modes_of].part != Part::own)
      members[*member.modes_of].part = Part::lent;
}

}  // namespace rondo::study
