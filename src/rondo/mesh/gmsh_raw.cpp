// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/gmsh_raw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <type_traits>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/mesh/gmsh_program.hpp"
#include "rondo/mesh/gmsh_stream.hpp"

namespace rondo::mesh {
namespace {

class Stream {
 public:
  Stream(const ReadBytes& read, std::uint64_t file_bytes) : read_(read), file_bytes_(file_bytes) {}

  void get(void* data, std::size_t size) {
    auto* at = static_cast<char*>(data);
    while (size > 0) {
      const std::size_t got = read_(at, size);
      if (got == 0) throw BadStream{.ended = true};
      at += got;
      size -= got;
    }
  }

  template <class Number>
  requires std::is_trivially_copyable_v<Number> Number get() {
    Number value{};
    get(&value, sizeof value);
    return value;
  }

  /// `bytes`: the least that one of the items takes in a file.
  std::size_t count(std::uint64_t bytes = 1) {
    const auto n = get<std::uint64_t>();
    if (n > file_bytes_ / bytes) throw BadStream{};
    return static_cast<std::size_t>(n);
  }

  std::string text() {
    const auto n = get<std::uint64_t>();
    if (n > longest_text) throw BadStream{};
    std::string said(static_cast<std::size_t>(n), '\0');
    get(said.data(), said.size());
    return said;
  }

  template <class Number>
  std::vector<Number> array(std::size_t n) {
    std::vector<Number> numbers(n);
    get(numbers.data(), n * sizeof(Number));
    return numbers;
  }

 private:
  static constexpr std::uint64_t longest_text = 1U << 16;

  const ReadBytes& read_;
  std::uint64_t file_bytes_;
};

RawType read_type(Stream& stream) {
  RawType type;
  type.type = stream.get<int>();
  type.dimension = stream.get<int>();
  type.order = stream.get<int>();
  type.n_nodes = stream.get<int>();
  type.name = stream.text();
  if (type.dimension < 0 || type.dimension > 3 || type.n_nodes < 0 || type.n_nodes > 10000)
    throw BadStream{};
  return type;
}

RawGroup read_group(Stream& stream) {
  RawGroup group;
  group.dimension = stream.get<int>();
  group.tag = stream.get<int>();
  group.name = stream.text();
  return group;
}

RawEntity read_entity(Stream& stream) {
  RawEntity entity;
  entity.dimension = stream.get<int>();
  entity.tag = stream.get<int>();
  entity.groups = stream.array<int>(stream.count());
  if (entity.dimension < 0 || entity.dimension > 3) throw BadStream{};
  return entity;
}

/// Maps dimension and tag to the index in RawMesh::entities.
using EntityPlaces = std::map<std::pair<int, int>, std::size_t>;

/// An element takes at least two characters per node in a file.
RawBlock read_block(Stream& stream, const RawMesh& raw, const EntityPlaces& places) {
  const auto dimension = stream.get<int>(), tag = stream.get<int>(), type = stream.get<int>();
  const auto entity = places.find({dimension, tag});
  const auto kind = std::ranges::find(raw.types, type, &RawType::type);
  if (entity == places.end() || kind == raw.types.end()) throw BadStream{};
  RawBlock block;
  block.entity = entity->second;
  block.type = static_cast<std::size_t>(kind - raw.types.begin());
  const auto nodes = static_cast<std::size_t>(kind->n_nodes);
  const std::size_t n = stream.count(2 * std::max<std::size_t>(nodes, 1));
  block.tags = stream.array<std::uint64_t>(n);
  block.nodes = stream.array<std::uint64_t>(n * nodes);
  return block;
}

RawMesh read_mesh(Stream& stream) {
  RawMesh raw;
  raw.nodes_in_file = stream.get<std::uint64_t>();
  for (std::size_t n = stream.count(); n > 0; --n) raw.warnings.push_back(stream.text());
  for (std::size_t n = stream.count(); n > 0; --n) raw.types.push_back(read_type(stream));
  for (std::size_t n = stream.count(); n > 0; --n) raw.groups.push_back(read_group(stream));
  for (std::size_t n = stream.count(); n > 0; --n) raw.entities.push_back(read_entity(stream));
  EntityPlaces places;
  for (const RawEntity& entity : raw.entities)
    places.emplace(std::pair{entity.dimension, entity.tag}, places.size());
  if (places.size() != raw.entities.size()) throw BadStream{};
  const std::size_t n = stream.count(8);  // "1 0 0 0" and a line feed
  raw.node_tags = stream.array<std::uint64_t>(n);
  raw.places = stream.array<double>(3 * n);
  for (std::size_t left = stream.count(); left > 0; --left)
    raw.blocks.push_back(read_block(stream, raw, places));
  if (stream.get<std::uint64_t>() != stream_end) throw BadStream{};
  return raw;
}

Fault fault_of(const std::filesystem::path& file, std::string message) {
  constexpr const char* formats =
      "MSH 2.2 or 4.1 as Gmsh writes it: gmsh -2 FILE.geo -format msh41";
  return {file.string(), 0, 0, "", "", std::move(message), formats};
}

}  // namespace

RawStream read_stream(const ReadBytes& read, std::uint64_t file_bytes) {
  Stream stream(read, file_bytes);
  if (stream.get<std::uint64_t>() != stream_start) throw BadStream{};
  if (stream.get<std::uint32_t>() == static_cast<std::uint32_t>(StreamStatus::mesh))
    return {read_mesh(stream), {}};
  return {std::nullopt, stream.text()};
}

RawMesh read_raw_mesh(const std::filesystem::path& file, std::uint64_t file_bytes) {
  ReaderProgram program(find_reader_program(), file);
  std::string why;
  try {
    RawStream stream = read_stream(
        [&](void* data, std::size_t size) { return program.read(data, size); }, file_bytes);
    if (stream.mesh) return std::move(*stream.mesh);
    why = std::move(stream.why);
  } catch (const BadStream& bad) {
    const std::string end = bad.ended ? program.wait() : (program.kill(), std::string{});
    constexpr const char* not_loaded = "exit code 127";
    if (end.empty() || end.starts_with(not_loaded))
      throw FileError(program.program().string(),
                      fmt::format("is no working mesh reader of this version of rondo{}",
                                  end.empty() ? "" : ": it ended with " + end));
    throw InputError(fault_of(
        file,
        fmt::format("cannot be read: the Gmsh library did not survive it, ended by {}", end)));
  }
  throw InputError(fault_of(file, fmt::format("cannot be read: {}", why)));
}

}  // namespace rondo::mesh
