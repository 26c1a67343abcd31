// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstdlib>

#include "sections.hpp"

namespace rondo::reader {
namespace {

constexpr std::array<const char*, 4> kinds{"point", "curve", "surface", "volume"};

/// Reads a count: unsigned, and no larger than the file.
std::uint64_t count(Counting& c) {
  return c.in.get<std::uint64_t>();
}

std::string entity_text(int dimension, int tag) {
  return std::string(kinds[static_cast<std::size_t>(dimension)]) + " " + std::to_string(tag);
}

/// Position or box, physical tags, and, except for points, the bounding entities.
void rest_of_entity(Counting& c, int dimension, int tag) {
  c.in.skip_doubles(dimension == 0 ? 3 : 6);
  const auto [at, fresh] = c.census.groups.try_emplace({dimension, tag});
  if (!fresh) c.in.fail("the " + entity_text(dimension, tag) + " is there twice");
  for (std::uint64_t n = count(c); n > 0; --n) at->second.insert(magnitude(c, c.in.get<int>()));
  if (dimension == 0) return;
  for (std::uint64_t n = count(c); n > 0; --n) c.in.get<int>();
}

using Counts = std::array<std::uint64_t, 4>;

Counts announce_entities(Counting& c) {
  Counts n{};
  std::uint64_t all = 0;
  for (std::uint64_t& of : n) all += of = count(c);
  c.in.announce(all, "points, curves, surfaces and volumes");
  return n;
}

void count_part(Counting& c, int dimension) {
  const int tag = c.in.get<int>(), parent_dimension = c.in.get<int>();
  c.in.get<int>();
  std::vector<int>& parts = c.parts[{dimension, tag}];
  for (std::uint64_t n = count(c); n > 0; --n) parts.push_back(c.in.get<int>());
  if (parent_dimension > dimension) c.census.between_parts.insert({dimension, tag});
  // The tag may also be that of an entity of the geometry, which then has no elements.
  c.census.groups.erase({dimension, tag});
  rest_of_entity(c, dimension, tag);
}

struct BlockHead {
  int dimension = 0, tag = 0;
};

BlockHead block_head(Counting& c) {
  BlockHead head;
  head.dimension = c.in.get<int>();
  head.tag = c.in.get<int>();
  if (head.dimension < 0 || head.dimension > 3)
    c.in.fail("a block of $" + c.in.name() + " has the dimension " +
              std::to_string(head.dimension));
  if (c.census.groups.count({head.dimension, head.tag}) == 0 &&
      c.census.ghosts.count({head.dimension, head.tag}) == 0)
    c.in.fail("a block of $" + c.in.name() + " is on the " + entity_text(head.dimension, head.tag) +
              ", which no $Entities before it has (files of other writers: MSH 2.2 needs none)");
  return head;
}

/// The header of a section: numbers of blocks and of items, smallest and largest tag.
struct SectionHead {
  std::uint64_t blocks = 0, n = 0, least = 0, largest = 0, found = 0;
};

SectionHead section_head(Counting& c) {
  SectionHead head;
  head.blocks = count(c);
  head.n = count(c);
  head.least = count(c);
  head.largest = count(c);
  return head;
}

std::uint64_t tag_of(Counting& c, SectionHead& head) {
  const auto tag = c.in.get<std::uint64_t>();
  if (tag < head.least || tag > head.largest)
    c.in.fail("$" + c.in.name() + " says tags from " + std::to_string(head.least) + " to " +
              std::to_string(head.largest) + ", and has " + std::to_string(tag));
  ++head.found;
  return tag;
}

void demand_all(Counting& c, const SectionHead& head, const std::string& what) {
  c.in.announce(head.blocks, "blocks");
  c.in.end_section();
  if (head.found != head.n)
    c.in.fail("$" + c.in.name() + " says " + std::to_string(head.n) + " " + what + ", and its " +
              std::to_string(head.blocks) + " blocks have " + std::to_string(head.found));
}

}  // namespace

void count_entities_41(Counting& c) {
  if (c.in.is_binary()) c.in.end_line();
  const Counts n = announce_entities(c);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::uint64_t k = 0; k < n[static_cast<std::size_t>(dimension)]; ++k, c.in.next_thing())
      rest_of_entity(c, dimension, c.in.get<int>());
  c.in.end_section();
}

void count_parts_41(Counting& c) {
  if (c.in.is_binary()) c.in.end_line();
  c.census.n_parts = static_cast<int>(count(c));
  std::vector<int> ghosts;
  for (std::uint64_t n = count(c); n > 0; --n) {
    ghosts.push_back(c.in.get<int>());
    c.in.get<int>();
  }
  const Counts n = announce_entities(c);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::uint64_t k = 0; k < n[static_cast<std::size_t>(dimension)]; ++k, c.in.next_thing())
      count_part(c, dimension);
  c.in.end_section();
  for (const int tag : ghosts)
    for (const int dimension : {2, 3}) c.census.ghosts.insert({dimension, tag});
}

void count_nodes_41(Counting& c) {
  if (c.in.is_binary()) c.in.end_line();
  SectionHead head = section_head(c);
  Tags tags;
  for (std::uint64_t block = 0; block < head.blocks; ++block) {
    c.in.announce(head.blocks, "blocks", block);
    const int dimension = block_head(c).dimension, parametric = c.in.get<int>();
    const std::uint64_t n = count(c);
    c.in.announce(head.n, "nodes", head.found);
    for (std::uint64_t k = 0; k < n; ++k, c.in.next_thing()) tags.add(tag_of(c, head));
    const int numbers = 3 + (parametric != 0 ? dimension : 0);
    for (std::uint64_t k = 0; k < n; ++k) c.in.skip_doubles(static_cast<std::uint64_t>(numbers));
  }
  demand_all(c, head, "nodes");
  c.census.n_nodes = head.n;
  tags.demand_unique("nodes");
}

void count_elements_41(Counting& c) {
  if (c.in.is_binary()) c.in.end_line();
  SectionHead head = section_head(c);
  Tags tags;
  for (std::uint64_t block = 0; block < head.blocks; ++block) {
    c.in.announce(head.blocks, "blocks", block);
    const auto [dimension, tag] = block_head(c);
    const int type = c.in.get<int>();
    const std::uint64_t n = count(c);
    c.in.announce(head.n, "elements", head.found);
    const TypeShape shape = c.shape(type);
    if (shape.dimension != dimension)
      c.in.fail("a block of elements of dimension " + std::to_string(shape.dimension) + " (type " +
                std::to_string(type) + ") is on the " + entity_text(dimension, tag));
    for (std::uint64_t k = 0; k < n; ++k, c.in.next_thing()) {
      c.in.begin_record();
      tags.add(tag_of(c, head));
      for (int a = 0; a < shape.n_nodes; ++a) c.in.get<std::uint64_t>();
      c.in.end_record("an element of its type");
    }
    c.census.elements[{dimension, tag, type}] += n;
  }
  demand_all(c, head, "elements");
  tags.demand_unique("elements");
}

void demand_all_parts(const Counting& c) {
  if (c.census.n_parts == 0) return;
  int highest = 0;
  for (const auto& [key, n] : c.census.elements)
    if (n > 0) highest = std::max(highest, std::get<0>(key));
  std::set<int> here;
  for (const auto& [key, n] : c.census.elements) {
    const auto parts = c.parts.find({std::get<0>(key), std::get<1>(key)});
    if (n > 0 && std::get<0>(key) == highest && parts != c.parts.end())
      here.insert(parts->second.begin(), parts->second.end());
  }
  if (here.size() == static_cast<std::size_t>(c.census.n_parts)) return;
  std::string list;
  for (const int part : here) list += (list.empty() ? "" : ", ") + std::to_string(part);
  throw "the mesh was split into " + std::to_string(c.census.n_parts) +
      " parts, and the file has elements of part " + (list.empty() ? "none" : list) +
      " alone: the mesh made without -part, or all parts in one file without -part_split";
}

}  // namespace rondo::reader
