// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/packed_case.hpp"

#include <filesystem>

#include "rondo/case/case_source.hpp"
#include "rondo/io/files.hpp"
#include "rondo/mesh/kept_mesh.hpp"
#include "rondo/road/road.hpp"

namespace rondo::fmu {
namespace {

constexpr const char *mesh_name = "section.mesh", *road_name = "road.crg";

/// The file of the road, which must hold its heights itself.
std::string road_text(const study::Case& c) {
  const std::filesystem::path file = c.ground->road.file;
  std::error_code error;
  if (std::filesystem::equivalent(file, c.ground->road.read->file, error)) return io::text_of(file);
  throw study::case_error(c, "ground.road", "refers to another file, and an FMU takes one along",
                          "the file that has the heights: " + c.ground->road.read->file);
}

}  // namespace

std::vector<Resource> packed_case(const study::Case& c) {
  study::Case packed = c;
  std::vector<Resource> files;
  if (packed.section) {
    files.emplace_back(mesh_name, mesh::keep_mesh(c.section->mesh.file));
    packed.section->mesh.file = mesh_name;
  }
  if (study::is_on_road_surface(c)) {
    files.emplace_back(road_name, road_text(c));
    packed.ground->road.file = road_name;
  }
  files.emplace(files.begin(), "case.toml", study::write_case(packed));
  return files;
}

}  // namespace rondo::fmu
