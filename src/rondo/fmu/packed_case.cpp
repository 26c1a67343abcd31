// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/packed_case.hpp"

#include "rondo/mesh/kept_mesh.hpp"

namespace rondo::fmu {
namespace {

constexpr const char* mesh_name = "section.mesh";

}  // namespace

std::vector<Resource> packed_case(const study::Case& c) {
  study::Case packed = c;
  std::vector<Resource> files;
  if (packed.section) {
    files.emplace_back(mesh_name, mesh::keep_mesh(c.section->mesh.file));
    packed.section->mesh.file = mesh_name;
  }
  files.emplace(files.begin(), "case.toml", study::write_case(packed));
  return files;
}

}  // namespace rondo::fmu
