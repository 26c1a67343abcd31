// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/kept_mesh.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/mesh/gmsh_draft.hpp"
#include "rondo/mesh/gmsh_program.hpp"

namespace rondo::mesh {
namespace {

constexpr std::string_view heading_41 = "rondo mesh of MSH 4.1\n",
                           heading_22 = "rondo mesh of MSH 2.2\n";

InputError damaged(const std::filesystem::path& file) {
  return InputError(Fault{file.string(), 0, 0, "", "", "is a damaged mesh of an FMU",
                          "the file that rondo fmu has written, on a machine of the same kind"});
}

}  // namespace

std::string keep_mesh(const std::filesystem::path& gmsh_file) {
  std::string text(inspect(gmsh_file).version_22 ? heading_22 : heading_41);
  ReaderProgram program(find_reader_program(), gmsh_file);
  std::array<char, 1 << 16> part{};
  while (const std::size_t got = program.read(part.data(), part.size()))
    text.append(part.data(), got);
  const std::string end = program.wait();
  if (end.empty()) return text;
  throw FileError(program.program().string(), "is no working mesh reader: it ended with " + end);
}

std::optional<KeptMesh> read_kept_mesh(const std::filesystem::path& file) {
  demand_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  std::string heading(heading_41.size(), '\0');
  in.read(heading.data(), static_cast<std::streamsize>(heading.size()));
  if (!in || (heading != heading_41 && heading != heading_22)) return std::nullopt;
  const std::string text(std::istreambuf_iterator<char>(in), {});
  std::string_view left = text;
  const auto read = [&](void* data, std::size_t size) {
    const std::size_t got = left.copy(static_cast<char*>(data), size);
    left.remove_prefix(got);
    return got;
  };
  try {
    RawStream stream = read_stream(read, text.size());
    if (!stream.mesh) throw damaged(file);
    return KeptMesh{std::move(*stream.mesh), heading == heading_22};
  } catch (const BadStream&) {
    throw damaged(file);
  }
}

}  // namespace rondo::mesh
