// SPDX-License-Identifier: BSD-3-Clause
#include "census.hpp"

#include <algorithm>
#include <array>

#include "sections.hpp"

namespace rondo::reader {
namespace {

void read_format(Counting& c) {
  c.census.version = c.in.word();
  const int is_binary = c.in.parsed<int>(), bytes = c.in.parsed<int>();
  if (bytes != 8) c.in.fail("numbers of " + std::to_string(bytes) + " bytes, where 8 are read");
  c.in.end_line();
  if (is_binary == 0) return c.in.announce(3, "numbers"), c.in.end_section();
  c.in.set_binary(false);
  if (c.in.get<int>() != 1) c.in.set_binary(true);
  c.in.announce(1, "numbers");
  c.in.end_section();
}

std::string group_text(const Id& group) {
  constexpr std::array<const char*, 4> kinds{"point", "curve", "surface", "volume"};
  return std::string("physical ") + kinds[static_cast<std::size_t>(group.first)] + " " +
         std::to_string(group.second);
}

void read_names(Counting& c) {
  const auto n = c.in.parsed<std::uint64_t>();
  c.in.announce(n, "names");
  for (std::uint64_t k = 0; k < n; ++k, c.in.next_thing()) {
    const int dimension = c.in.parsed<int>(), tag = c.in.parsed<int>();
    if (dimension < 0 || dimension > 3)
      c.in.fail("a physical group has the dimension " + std::to_string(dimension));
    const std::string_view rest = c.in.rest_of_line();
    const std::size_t start = rest.find('"'), end = rest.find('"', start + 1);
    if (start == std::string_view::npos || end == std::string_view::npos)
      c.in.fail("the name of the " + group_text({dimension, tag}) +
                ", in the line before, is not in quotation marks");
    const std::string name(rest.substr(start + 1, end - start - 1));
    const auto [known, fresh] = c.census.names.try_emplace({dimension, tag}, name);
    if (!fresh && known->second != name)
      c.in.fail("the " + group_text({dimension, tag}) + " has two names, " + quoted(known->second) +
                " and " + quoted(name));
  }
  c.in.end_section();
}

using ReadSection = void (*)(Counting&);

ReadSection reader_of(const std::string& name, bool is_22) {
  if (name == "MeshFormat") return read_format;
  if (name == "PhysicalNames") return read_names;
  if (name == "Nodes") return is_22 ? count_nodes_22 : count_nodes_41;
  if (name == "Elements") return is_22 ? count_elements_22 : count_elements_41;
  if (name == "Entities" && !is_22) return count_entities_41;
  if (name == "PartitionedEntities" && !is_22) return count_parts_41;
  return nullptr;
}

}  // namespace

void Tags::add(std::uint64_t tag) {
  ascending_ = ascending_ && (tags_.empty() || tags_.back() < tag);
  tags_.push_back(tag);
}

void Tags::demand_unique(const std::string& what) {
  if (ascending_) return;
  std::sort(tags_.begin(), tags_.end());
  const auto twice = std::adjacent_find(tags_.begin(), tags_.end());
  if (twice != tags_.end()) throw "two " + what + " have the number " + std::to_string(*twice);
}

TypeShape Counting::shape(int type) {
  const auto [at, fresh] = shapes.try_emplace(type);
  if (fresh) at->second = shape_of(type);
  if (at->second.n_nodes <= 0)
    in.fail("there is no type " + std::to_string(type) + " of elements that can be read");
  return at->second;
}

Census take_census(std::string_view text, const ShapeOf& shape_of) {
  Census census;
  Scanner in(text);
  Counting counting{in, shape_of, census};
  std::set<std::string> seen;
  while (in.next_section()) {
    const ReadSection read = reader_of(in.name(), census.version.starts_with("2"));
    if (read != nullptr && !seen.insert(in.name()).second)
      in.fail("$" + in.name() + " is there twice");
    if (read != nullptr)
      read(counting);
    else
      in.skip_section();
  }
  demand_all_parts(counting);
  return census;
}

}  // namespace rondo::reader
