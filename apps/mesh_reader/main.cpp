// SPDX-License-Identifier: BSD-3-Clause
/// Reads a mesh with the Gmsh library and writes it as plain arrays (rondo/mesh/gmsh_stream.hpp):
///     rondo-mesh-reader FILE > STREAM
/// Exit code 0 if the stream is complete, even if it only says why there is no mesh.
#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "census.hpp"
#include "limits.hpp"
#include "rondo/mesh/gmsh_stream.hpp"
#include "source_text.hpp"

namespace {

using rondo::mesh::StreamStatus;
using rondo::reader::Census;
using rondo::reader::Id;
using rondo::reader::TypeShape;

void put(const void* data, std::size_t size) {
  if (size > 0 && std::fwrite(data, 1, size, stdout) != size) std::exit(1);
}

template <class Number>
void put(Number value) {
  put(&value, sizeof value);
}

void put_count(std::size_t n) {
  put(static_cast<std::uint64_t>(n));
}

void put_text(const std::string& text) {
  put_count(text.size());
  put(text.data(), text.size());
}

template <class Number>
void put_all(const std::vector<Number>& numbers) {
  put(numbers.data(), numbers.size() * sizeof(Number));
}

/// Lines of the library's log that begin with a word, without that word.
std::vector<std::string> logged(const std::string& word) {
  std::vector<std::string> lines, found;
  gmsh::logger::get(lines);
  for (const std::string& line : lines)
    if (line.starts_with(word + ": ")) found.push_back(line.substr(word.size() + 2));
  return found;
}

void put_types() {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types);
  put_count(types.size());
  for (const int type : types) {
    std::string name;
    int dimension = 0, order = 0, nodes = 0, corners = 0;
    std::vector<double> places;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, places, corners);
    for (const int number : {type, dimension, order, nodes}) put(number);
    put_text(name);
  }
}

/// Names come from the file: of two groups with one name, the library forgets the second.
void put_groups(const Census& census) {
  std::map<Id, std::string> named = census.names;
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const Id& group : groups) named.try_emplace(group);
  put_count(named.size());
  for (const auto& [group, name] : named) put(group.first), put(group.second), put_text(name);
}

std::vector<int> groups_of(const Census& census, const Id& entity) {
  std::vector<int> physical;
  if (census.between_parts.count(entity) == 0)
    gmsh::model::getPhysicalGroupsForEntity(entity.first, entity.second, physical);
  for (int& tag : physical) tag = std::abs(tag);  // a negative sign reverses the normal
  return physical;
}

/// Entities whose elements are read: not those with copies; of a partitioned mesh only the parts.
std::vector<Id> entities_of(const Census& census) {
  gmsh::vectorpair all;
  gmsh::model::getEntities(all);
  std::vector<Id> entities;
  for (const Id& entity : all) {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, entity.first, entity.second);
    const bool is_parent = census.n_parts > 0 && types.empty();
    if (!is_parent && census.ghosts.count(entity) == 0) entities.push_back(entity);
  }
  return entities;
}

void put_entities(const Census& census, const std::vector<Id>& entities) {
  put_count(entities.size());
  for (const Id& entity : entities) {
    const std::vector<int> physical = groups_of(census, entity);
    put(entity.first), put(entity.second), put_count(physical.size()), put_all(physical);
  }
}

void put_nodes() {
  std::vector<std::size_t> tags;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(tags, places, parameters, -1, -1, false, false);
  put_count(tags.size()), put_all(tags), put_all(places);
}

struct Block {
  int dimension, entity, type;
  std::vector<std::size_t> elements, nodes;
};

std::vector<Block> blocks_of(const std::vector<Id>& entities) {
  std::vector<Block> blocks;
  for (const auto& [dimension, tag] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
    for (std::size_t k = 0; k < types.size(); ++k)
      blocks.push_back({dimension, tag, types[k], std::move(elements[k]), std::move(nodes[k])});
  }
  return blocks;
}

/// Throws std::string if the library has not read everything that the file contains.
void demand_all_groups(const Census& census, const std::vector<Id>& entities) {
  for (const Id& entity : entities) {
    const std::vector<int> taken = groups_of(census, entity);
    const auto known = census.groups.find(entity);
    if (known == census.groups.end() || census.between_parts.count(entity) > 0 ||
        std::set<int>(taken.begin(), taken.end()) == known->second)
      continue;
    throw "the file has the entity " + std::to_string(entity.second) + " of dimension " +
        std::to_string(entity.first) + " in other physical groups than the Gmsh library";
  }
}

void demand_all_elements(const Census& census, const std::vector<Block>& blocks) {
  std::map<std::tuple<int, int, int>, std::uint64_t> taken;
  for (const Block& block : blocks)
    taken[{block.dimension, block.entity, block.type}] += block.elements.size();
  for (const auto& [key, n] : census.elements) {
    if (taken[key] == n) continue;
    const auto [dimension, entity, type] = key;
    throw "the file has " + std::to_string(n) + " elements of type " + std::to_string(type) +
        " with the elementary tag " + std::to_string(entity) + ", and the Gmsh library takes " +
        std::to_string(taken[key]) + " of them";
  }
}

void put_elements(const std::vector<Block>& blocks) {
  put_count(blocks.size());
  for (const Block& block : blocks) {
    put(block.dimension), put(block.entity), put(block.type), put_count(block.elements.size());
    put_all(block.elements), put_all(block.nodes);
  }
}

/// One line of the library's warnings, and what was changed in the file here.
std::vector<std::string> warnings_of(const Census& census) {
  std::vector<std::string> warnings;
  const std::vector<std::string> said = logged("Warning");
  constexpr std::size_t most = 5;
  for (std::size_t k = 0; k < std::min(most, said.size()); ++k)
    (k == 0 ? warnings.emplace_back("the Gmsh library says: ") : warnings.back() += ", ") +=
        said[k];
  if (said.size() > most) warnings.back() += " and " + std::to_string(said.size() - most) + " more";
  if (census.n_parts > 0)
    warnings.push_back("the mesh is in " + std::to_string(census.n_parts) +
                       " parts (gmsh -part), which are all in the file: they are joined");
  if (!census.ghosts.empty())
    warnings.emplace_back("copies of elements for other parts (gmsh -part_ghosts) are left out");
  return warnings;
}

void put_mesh(const Census& census) {
  const std::vector<Id> entities = entities_of(census);
  const std::vector<Block> blocks = blocks_of(entities);
  demand_all_groups(census, entities);
  demand_all_elements(census, blocks);
  put(rondo::mesh::stream_start), put(StreamStatus::mesh), put(census.n_nodes);
  const std::vector<std::string> warnings = warnings_of(census);
  put_count(warnings.size());
  for (const std::string& warning : warnings) put_text(warning);
  put_types();
  put_groups(census);
  put_entities(census, entities);
  put_nodes();
  put_elements(blocks);
  put(rondo::mesh::stream_end);
}

void put_failure(const std::string& why) {
  put(rondo::mesh::stream_start), put(StreamStatus::failure), put_text(why);
}

TypeShape shape_of(int type) {
  std::string name;
  int dimension = 0, order = 0, nodes = 0, corners = 0;
  std::vector<double> places;
  try {
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, places, corners);
  } catch (...) {
    return {};
  }
  return {dimension, nodes};
}

/// Throws std::string. The path has no extension: the library examines only the text.
void read(int file) {
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  std::string why;
  try {
    gmsh::merge(path);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    why = "damaged";
  }
  for (std::string line : logged("Error")) {
    if (const auto at = line.find(path); at != std::string::npos)
      line.replace(at, path.size(), "the file");
    if (line != "Error loading 'the file'") why = line;
  }
  if (!why.empty()) throw why;
}

int serve(const char* path) {
  std::uint64_t memory = 0;
  try {
    const rondo::reader::SourceText source(path);
    gmsh::initialize(0, nullptr, false);  // ignores the user's option files
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    memory = rondo::reader::limit_process(source.size);
    const Census census = rondo::reader::take_census({source.text, source.size}, shape_of);
    gmsh::logger::start();
    read(source.file);
    put_mesh(census);
  } catch (const std::string& why) {
    put_failure(why);
  } catch (const std::bad_alloc&) {
    put_failure("it asks for more memory than a file of its size can need (" +
                std::to_string(memory >> 20) + " MB)");
  } catch (const std::exception& error) {
    put_failure(error.what());
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || isatty(STDOUT_FILENO) != 0) {
    std::fputs("usage: rondo-mesh-reader FILE > STREAM\nReads a Gmsh mesh for rondo.\n", stderr);
    return 2;
  }
  _exit(serve(argv[1]));  // freeing a large mesh would take the library a second
}
