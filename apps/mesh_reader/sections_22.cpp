// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <limits>

#include "sections.hpp"

namespace rondo::reader {
namespace {

/// Reads the number of the element, its tags and nodes. @param n_tags physical, elementary, parts
void count_element(Counting& c, int type, int n_tags) {
  const TypeShape shape = c.shape(type);
  int physical = 0, elementary = 0, parts = 0;
  for (int k = 0; k < n_tags; ++k) {
    const int tag = c.in.get<int>();
    if (k == 0) physical = tag;
    if (k == 1) elementary = tag;
    if (k == 2) parts = tag;
  }
  if (parts > 0)
    c.in.fail(
        "the elements are those of a mesh in parts (gmsh -part), and MSH 2.2 does not tell "
        "whether all of them are here: the mesh made without -part, or all parts in one file of "
        "MSH 4.1 without -part_split");
  for (int k = 0; k < shape.n_nodes; ++k) c.in.get<int>();
  ++c.census.elements[{shape.dimension, elementary, type}];
  std::set<int>& groups = c.census.groups[{shape.dimension, elementary}];
  if (physical != 0) groups.insert(magnitude(c, physical));
}

void demand_count_of_tags(Counting& c, int n_tags) {
  constexpr int most = 1000;
  if (n_tags < 0 || n_tags > most) c.in.fail("an element has " + std::to_string(n_tags) + " tags");
}

void count_text_elements(Counting& c, std::uint64_t n, Tags& tags) {
  for (std::uint64_t k = 0; k < n; ++k, c.in.next_thing()) {
    c.in.begin_record();
    tags.add(c.in.get<unsigned>());
    const int type = c.in.get<int>(), n_tags = c.in.get<int>();
    demand_count_of_tags(c, n_tags);
    count_element(c, type, n_tags);
    c.in.end_record("an element of its type and its number of tags");
  }
}

void count_binary_elements(Counting& c, std::uint64_t n, Tags& tags) {
  for (std::uint64_t done = 0; done < n;) {
    const int type = c.in.get<int>(), here = c.in.get<int>(), n_tags = c.in.get<int>();
    demand_count_of_tags(c, n_tags);
    if (here <= 0 || static_cast<std::uint64_t>(here) > n - done)
      c.in.fail("$Elements says " + std::to_string(n) + " elements, and after " +
                std::to_string(done) + " of them a block of " + std::to_string(here));
    for (int k = 0; k < here; ++k, c.in.next_thing()) {
      tags.add(c.in.get<unsigned>());
      count_element(c, type, n_tags);
    }
    done += static_cast<std::uint64_t>(here);
  }
}

}  // namespace

int magnitude(Counting& c, int physical) {
  if (physical == std::numeric_limits<int>::min())
    c.in.fail("a physical group has the number " + std::to_string(physical) +
              ": numbers have at most 31 bits");
  return std::abs(physical);
}

void count_nodes_22(Counting& c) {
  const auto n = c.in.parsed<std::uint64_t>();
  if (c.in.is_binary()) c.in.end_line();
  c.in.announce(n, "nodes");
  Tags tags;
  for (std::uint64_t k = 0; k < n; ++k, c.in.next_thing()) {
    c.in.begin_record();
    const int tag = c.in.get<int>();
    if (tag < 1) c.in.fail("a node has the tag " + std::to_string(tag));
    tags.add(static_cast<std::uint64_t>(tag));
    c.in.skip_doubles(3);
    c.in.end_record("a node");
  }
  c.in.end_section();
  c.census.n_nodes = n;
  tags.demand_unique("nodes");
}

void count_elements_22(Counting& c) {
  const auto n = c.in.parsed<std::uint64_t>();
  if (c.in.is_binary()) c.in.end_line();
  c.in.announce(n, "elements");
  Tags tags;
  c.in.is_binary() ? count_binary_elements(c, n, tags) : count_text_elements(c, n, tags);
  c.in.end_section();
  tags.demand_unique("elements");
}

}  // namespace rondo::reader
