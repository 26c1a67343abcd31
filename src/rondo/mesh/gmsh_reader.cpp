// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/gmsh_reader.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <utility>

#include "rondo/core/files/regular_file.hpp"
#include "rondo/mesh/gmsh_draft.hpp"
#include "rondo/mesh/kept_mesh.hpp"

namespace rondo::mesh {
namespace {

constexpr const char* formats =
    "MSH 2.2 or 4.1, text or binary: gmsh FILE -save -format msh41 -o NEW.msh";

/// An element takes at least six bytes, so that cells and nodes of smaller files fit into int.
constexpr std::uint64_t largest_file = 12'000'000'000;

/// Throws FileError with the reason why the file cannot be opened.
std::pair<std::string, std::uint64_t> beginning_of(const std::filesystem::path& file) {
  demand_regular_file(file);
  const int opened = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0)
    throw FileError(file.string(), fmt::format("cannot be opened: {}", std::strerror(errno)));
  struct stat status {};
  std::array<char, 4096> text{};
  const ssize_t got = fstat(opened, &status) == 0 ? pread(opened, text.data(), text.size(), 0) : -1;
  const int error = errno;
  close(opened);
  if (got < 0)
    throw FileError(file.string(), fmt::format("cannot be read: {}", std::strerror(error)));
  return {std::string(text.data(), static_cast<std::size_t>(got)),
          static_cast<std::uint64_t>(status.st_size)};
}

Fault file_fault(const std::filesystem::path& file, std::string message) {
  return {file.string(), 0, 0, "", "", std::move(message), formats};
}

void check_request(const MeshRequest& request) {
  if (std::isfinite(request.scale) && request.scale > 0.0) return;
  throw InputError(Fault{request.file.string(), 0, 0, "scale", fmt::format("{}", request.scale),
                         "is no scale of lengths", "> 0"});
}

}  // namespace

void Findings::add(std::string message, std::string allowed) {
  faults.push_back({file, 0, 0, "", "", std::move(message), std::move(allowed)});
}

void Findings::throw_if_faulty() {
  if (!faults.empty()) throw InputError(std::move(faults));
}

MeshFile inspect(const std::filesystem::path& file) {
  const auto [text, bytes] = beginning_of(file);
  if (bytes == 0) throw InputError(file_fault(file, "is empty"));
  if (bytes > largest_file)
    throw InputError(file_fault(file, fmt::format("has {:.3g} GB, more than can be read",
                                                  static_cast<double>(bytes) * 1e-9)));
  // Only a mesh may reach the library, which would run any other text as a script.
  const std::string heading = "$MeshFormat";
  const auto at = text.starts_with("$Comments") ? text.find("\n" + heading) : text.find(heading);
  if (at == std::string::npos || (at > 0 && !text.starts_with("$Comments")))
    throw InputError(file_fault(file, "is no Gmsh mesh: it does not begin with $MeshFormat"));
  std::istringstream words(text.substr(text.find('$', at) + heading.size()));
  std::string version;
  words >> version;
  if (version != "2.2" && version != "4.1")
    throw InputError(
        file_fault(file, fmt::format("is of format \"{}\", which is not read", version)));
  return {bytes, version == "2.2"};
}

ReadMesh read_gmsh(const MeshRequest& request) {
  check_request(request);
  if (const std::optional<KeptMesh> kept = read_kept_mesh(request.file))
    return mesh_of(kept->mesh, kept->version_22, request);
  const MeshFile file = inspect(request.file);
  return mesh_of(read_raw_mesh(request.file, file.bytes), file.version_22, request);
}

ReadMesh mesh_of(const RawMesh& raw, bool version_22, const MeshRequest& request) {
  Findings findings{.file = request.file.string(), .faults = {}, .warnings = {}};
  findings.warnings = raw.warnings;
  const std::vector<NamedGroup> groups = named_groups(raw);
  warn_of_groups(raw, groups, findings);
  check_names(request, groups, findings);
  const TagIndex index(raw.node_tags);
  check_types(raw, index, findings);
  const std::size_t faults = findings.faults.size();
  Draft draft = draft_mesh(raw, index, request, findings);
  if (findings.faults.size() == faults) check_shapes(raw, draft, findings);
  findings.throw_if_faulty();

  const EdgeTable table(draft.mesh);
  check_joints(draft, table, findings);
  add_regions(raw, groups, draft, findings);
  const CurveInput curves{raw, index, groups, table, request, version_22};
  add_curves(curves, draft, findings);
  findings.throw_if_faulty();

  add_boundary(curves, draft, findings);
  findings.throw_if_faulty();
  return {std::move(draft.mesh), std::move(findings.warnings)};
}

}  // namespace rondo::mesh
