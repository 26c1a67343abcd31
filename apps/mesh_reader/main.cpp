// SPDX-License-Identifier: BSD-3-Clause
/// Reads a mesh with the Gmsh library and writes it as plain arrays (rondo/mesh/gmsh_stream.hpp):
///     rondo-mesh-reader FILE > STREAM
/// Exit code 0 when the stream is whole, also where it only says why there is no mesh.
#include <gmsh.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "limits.hpp"
#include "rondo/mesh/gmsh_stream.hpp"
#include "source_text.hpp"

namespace {

using rondo::mesh::StreamStatus;

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

/// Lines of the library's log that begin with a word, without it.
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

void put_groups() {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  put_count(groups.size());
  for (const auto& [dimension, tag] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    put(dimension), put(tag), put_text(name);
  }
}

gmsh::vectorpair put_entities() {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  put_count(entities.size());
  for (const auto& [dimension, tag] : entities) {
    std::vector<int> physical;
    gmsh::model::getPhysicalGroupsForEntity(dimension, tag, physical);
    put(dimension), put(tag), put_count(physical.size()), put_all(physical);
  }
  return entities;
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

void put_elements(const gmsh::vectorpair& entities) {
  std::vector<Block> blocks;
  for (const auto& [dimension, tag] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
    for (std::size_t k = 0; k < types.size(); ++k)
      blocks.push_back({dimension, tag, types[k], std::move(elements[k]), std::move(nodes[k])});
  }
  put_count(blocks.size());
  for (const Block& block : blocks) {
    put(block.dimension), put(block.entity), put(block.type), put_count(block.elements.size());
    put_all(block.elements), put_all(block.nodes);
  }
}

void put_mesh(std::uint64_t nodes_in_file) {
  put(rondo::mesh::stream_start), put(StreamStatus::mesh), put(nodes_in_file);
  const std::vector<std::string> warnings = logged("Warning");
  put_count(warnings.size());
  for (const std::string& warning : warnings) put_text(warning);
  put_types();
  put_groups();
  const gmsh::vectorpair entities = put_entities();
  put_nodes();
  put_elements(entities);
  put(rondo::mesh::stream_end);
}

void put_failure(const std::string& why) {
  put(rondo::mesh::stream_start), put(StreamStatus::failure), put_text(why);
}

/// Throws std::string. The path has no ending: the library looks at the text alone.
void read(const rondo::reader::SourceText& source) {
  if (const std::string missing = source.missing_end(); !missing.empty())
    throw "the file is cut: there is no " + missing;
  const std::string path = "/proc/self/fd/" + std::to_string(source.file);
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
    gmsh::initialize(0, nullptr, false);  // without the user's files of options
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    memory = rondo::reader::limit_process(source.size);
    gmsh::logger::start();
    read(source);
    put_mesh(source.n_nodes());
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
  _exit(serve(argv[1]));  // the library would take a second to free a large mesh
}
