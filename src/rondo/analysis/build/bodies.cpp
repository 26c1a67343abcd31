// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/solid/wheel_mesh.hpp"
#include "rondo/analysis/elements/parts.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/gmsh_reader.hpp"
#include "rondo/mesh/locate.hpp"
#include "rondo/mesh/mesh_check.hpp"
#include "rondo/mesh/physical_group.hpp"

namespace rondo::study {
namespace {

std::string file_table(const Case& c) {
  return c.mesh ? "mesh" : "section";
}

std::string scale_key(const Case& c) {
  return is_generated(c) ? "disk.outer_radius" : file_table(c) + ".scale";
}

/// Edges whose areas and stiffnesses would leave the range of the numbers.
void refuse_sizes_out_of_range(const Case& c, const std::vector<double>& size) {
  constexpr double smallest = 1e-60, largest = 1e60;
  const double shortest = *std::min_element(size.begin(), size.end());
  if (shortest >= smallest && shortest <= largest) return;
  throw case_error(c, scale_key(c),
                   fmt::format("the shortest edge of the mesh would be {:.3g} m, out of the range "
                               "of floating-point numbers",
                               shortest),
                   "lengths in metres");
}

/// Layers that coincide in round-off, by grading or by radii that are nearly the same.
void refuse_flat_elements(const Case& c, const std::vector<double>& size) {
  const double shortest = *std::min_element(size.begin(), size.end());
  if (shortest > 1e-9 * c.disk.outer_radius) return;
  const bool is_thin = c.wheel.width && *c.wheel.width / c.wheel.axial <= 2.0 * shortest;
  throw case_error(c,
                   is_thin                ? "disk.width"
                   : c.disk.grading > 1.0 ? "disk.mesh.grading"
                                          : "disk.inner_radius",
                   fmt::format("the shortest edge of the mesh would be {:.3g} m", shortest),
                   "a milder grading, fewer layers or columns, a thicker disk");
}

/// A key of the case that gives the name of a physical group.
struct NameKey {
  std::string key, name;
};

std::vector<NameKey> curve_keys(const Case& c) {
  std::vector<NameKey> keys;
  for (std::size_t k = 0; k < c.pressures.size(); ++k)
    keys.push_back({item_of("load.pressure", k) + ".curve", c.pressures[k].curve});
  if (c.inflation && !c.inflation->curve.empty())
    keys.push_back({"inflation.curve", c.inflation->curve});
  return keys;
}

/// Keys of curves whose edges may have cells on both sides.
std::vector<NameKey> line_keys(const Case& c) {
  std::vector<NameKey> keys;
  for (std::size_t k = 0; k < c.cords.size(); ++k)
    keys.push_back({item_of("cords", k) + ".curve", c.cords[k].curve});
  return keys;
}

std::vector<NameKey> surface_keys(const Case& c) {
  std::vector<NameKey> keys;
  for (std::size_t k = 0; !is_generated(c) && k < c.regions.size(); ++k)
    keys.push_back({item_of("material.region", k) + ".surface", c.regions[k].surface});
  for (std::size_t k = 0; k < c.initial.regions.size(); ++k)
    keys.push_back({item_of("initial.region", k) + ".surface", c.initial.regions[k].surface});
  return keys;
}

std::vector<std::string> names_of(const std::vector<NameKey>& keys) {
  std::vector<std::string> names;
  for (const NameKey& key : keys)
    if (std::find(names.begin(), names.end(), key.name) == names.end()) names.push_back(key.name);
  return names;
}

/// Keys of the case that a fault of the reader is about; none: it is about the file.
std::vector<std::string> keys_about(const Case& c, const Fault& fault) {
  if (fault.key == "clamped" || fault.key == "contact") return {file_table(c) + "." + fault.key};
  std::vector<NameKey> candidates;
  if (fault.key == "curve") {
    candidates = curve_keys(c);
    for (NameKey& key : line_keys(c)) candidates.push_back(std::move(key));
  }
  if (fault.key == "surface") candidates = surface_keys(c);
  std::vector<std::string> keys;
  for (const NameKey& key : candidates)
    if (fault.found == fmt::format("\"{}\"", key.name)) keys.push_back(key.key);
  return keys;
}

/// The reader's faults, those of names at the places where the case gives them.
std::vector<Fault> at_their_keys(const Case& c, const std::vector<Fault>& faults) {
  std::vector<Fault> told;
  for (const Fault& fault : faults) {
    const auto keys = keys_about(c, fault);
    for (const std::string& key : keys)
      told.push_back(
          case_error(c, key, fmt::format("in {}: {}", fault.file, fault.message), fault.allowed)
              .faults()
              .front());
    if (keys.empty()) told.push_back(fault);
  }
  return told;
}

}  // namespace

mesh::Mesh read_mesh_file(const Case& c, std::vector<std::string>* warnings) {
  RONDO_DEMAND(mesh_file_of(c) != nullptr, c.file.string());
  const MeshCase& m = *mesh_file_of(c);
  std::error_code error;
  if (!std::filesystem::exists(m.file, error))
    throw case_error(c, file_table(c) + ".file",
                     fmt::format("there is no file {}", m.file.string()),
                     "a Gmsh file, its path relative to the case file");
  try {
    mesh::ReadMesh read = mesh::read_gmsh({.file = m.file,
                                           .scale = m.scale,
                                           .clamped = m.clamped,
                                           .contact = m.contact,
                                           .curves = names_of(curve_keys(c)),
                                           .lines = names_of(line_keys(c)),
                                           .surfaces = names_of(surface_keys(c))});
    if (warnings)
      for (const std::string& warning : read.warnings)
        warnings->push_back(fmt::format("{}: {}", m.file.string(), warning));
    return std::move(read.mesh);
  } catch (const InputError& wrong) {
    throw InputError(at_their_keys(c, wrong.faults()));
  }
}

namespace {

/// Place of a surface among the regions of the mesh. @throws InputError: no cell is in it
int region_of(const Case& c, const mesh::Mesh& mesh, const NameKey& surface) {
  const auto& names = mesh.region_names;
  const auto found = std::find(names.begin(), names.end(), surface.name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  throw case_error(c, surface.key, "no cell of the mesh is in a physical surface of this name",
                   fmt::format("{}{}{}", fmt::join(names, ", "), names.empty() ? "" : "; or ",
                               mesh::physical_group_line("Surface", surface.name)));
}

/// Triangles lock sooner than quadrilaterals, of which the case's rules warn above 0.49.
void warn_of_locking_triangles(const Case& c, const mesh::Mesh& mesh,
                               std::vector<std::string>& warnings) {
  const std::vector<fem::Material> materials = materials_of(c, mesh);
  std::size_t found = 0;
  double largest = 0.0;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const fem::Material& m = fem::material_of(mesh, materials, e);
    if (mesh::n_corners(mesh.cells[e]) != 3 || m.plane != fem::Plane::strain ||
        m.integration != fem::Integration::full || m.poissons_ratio <= 0.45 ||
        m.poissons_ratio > 0.49)
      continue;
    ++found;
    largest = std::max(largest, m.poissons_ratio);
  }
  if (found == 0) return;
  warnings.push_back(
      fmt::format("{} of {} cells are triangles with full integration at Poisson's ratios up to "
                  "{}: in plane strain they are too stiff above 0.45. Use material.integration = "
                  "\"b-bar\", for triangles and quadrilaterals",
                  found, mesh.cells.size(), largest));
}

void refuse_for_held_bodies(const Case& c) {
  const Initial& i = c.initial;
  const auto refuse = [&](const std::string& key) {
    throw case_error(c, key, "is for unconstrained bodies, but the mesh has none",
                     "[motion], which moves what mesh.clamped holds");
  };
  if (i.position != Vec2{}) refuse("initial.position");
  if (i.turn != 0.0) refuse("initial.turn");
  if (i.angular_velocity != 0.0) refuse("initial.angular_velocity");
  if (!i.regions.empty()) refuse(item_of("initial.region", 0));
}

ProbeSite find_site(const Case& c, const mesh::CellGrid& grid, std::size_t k) {
  const Vec2 position = c.output.probes[k].position;
  for (const int e : grid.near(position))
    if (const auto weight = grid.within(e, position)) return {static_cast<std::size_t>(e), *weight};
  throw case_error(c, item_of("output.probe", k) + ".position",
                   fmt::format("is in no cell of the mesh: the nearest is {:.4g} m away",
                               grid.distance(position)),
                   "a point of the undeformed body, in metres");
}

}  // namespace

mesh::Mesh build_mesh(const Case& c, std::vector<std::string>* warnings) {
  if (is_solid(c)) {
    mesh::Mesh wheel = build_wheel(c, warnings);
    const std::vector<double> size = element_sizes(wheel);
    RONDO_DEMAND(!size.empty() && wheel.hexahedra.size() > 0 && wheel.n_sectors > 0, size.size(),
                 wheel.hexahedra.size(), wheel.n_sectors);
    refuse_sizes_out_of_range(c, size);
    if (is_generated(c)) refuse_flat_elements(c, size);
    return wheel;
  }
  if (!c.mesh)
    demand_memory(c, mesh::n_disk_nodes(c.disk), mesh_memory(mesh::n_disk_nodes(c.disk)));
  mesh::Mesh mesh = c.mesh ? read_mesh_file(c, warnings) : mesh::make_disk(c.disk);
  const std::vector<double> size = element_sizes(mesh);
  RONDO_DEMAND(
      !size.empty() && !mesh.cells.empty() && mesh.tributary.size() == mesh.boundary.size(),
      size.size(), mesh.cells.size(), mesh.tributary.size(), mesh.boundary.size());
  if (!c.mesh) refuse_flat_elements(c, size);
  refuse_sizes_out_of_range(c, size);
  if (!c.mesh) set_disk_regions(c, mesh);
  if (!c.mesh && c.free_rim) mesh.clamped.clear();
  if (c.mesh && mesh.clamped.size() == mesh.n_nodes())
    throw case_error(c, "mesh.clamped", "holds all nodes of the mesh: nothing can move",
                     "a curve that leaves nodes free, or a finer mesh");
  if (warnings) warn_of_locking_triangles(c, mesh, *warnings);
  return mesh;
}

std::vector<fem::Material> materials_of(const Case& c, const mesh::Mesh& mesh) {
  std::vector<fem::Material> materials(std::max<std::size_t>(1, mesh.region_names.size()),
                                       c.material);
  const auto keys = surface_keys(c);
  RONDO_DEMAND(!is_generated(c) || c.regions.size() < materials.size(), c.regions.size(),
               materials.size());  // set_disk_regions() has named them
  for (std::size_t k = 0; k < c.regions.size(); ++k)
    materials[!is_generated(c) ? at(region_of(c, mesh, keys[k])) : k + 1] = c.regions[k].material;
  return materials;
}

double extent_of(const mesh::Mesh& mesh) {
  RONDO_DEMAND(mesh.n_nodes() > 0, mesh.n_nodes());
  Vec2 low = mesh.coordinates.front(), high = low;
  for (const Vec2 x : mesh.coordinates) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y)};
  }
  return 0.5 * std::max(high.x - low.x, high.y - low.y);
}

namespace {

/// Its shortest edge: of the two faces, and between them.
void add_hexahedron(const mesh::Mesh& mesh, const mesh::Hexahedron& h, std::vector<double>& size) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto edge = [&](std::size_t a, std::size_t b) {
    const std::size_t i = at(h[a]), j = at(h[b]);
    const Vec3 x{mesh.coordinates[j] - mesh.coordinates[i], mesh.axial[j] - mesh.axial[i]};
    shortest = std::min(shortest, norm(x));
  };
  for (std::size_t a = 0; a < 4; ++a) {
    edge(a, (a + 1) % 4);
    edge(a + 4, (a + 1) % 4 + 4);
    edge(a, a + 4);
  }
  for (const int node : h) size[at(node)] = std::min(size[at(node)], shortest);
}

}  // namespace

std::vector<double> element_sizes(const mesh::Mesh& mesh) {
  RONDO_DEMAND(mesh.hexahedra.empty() || mesh.axial.size() == mesh.n_nodes(), mesh.axial.size(),
               mesh.n_nodes());
  std::vector<double> size(mesh.n_nodes(), std::numeric_limits<double>::infinity());
  for (const mesh::Cell& cell : mesh.cells) {
    const int n = mesh::n_corners(cell);
    double shortest = std::numeric_limits<double>::infinity();
    const auto corner = [&](int a) { return mesh.coordinates[at(cell[at(a % n)])]; };
    for (int a = 0; a < n; ++a) shortest = std::min(shortest, norm(corner(a + 1) - corner(a)));
    for (int a = 0; a < n; ++a) {
      double& s = size[at(cell[at(a)])];
      s = std::min(s, shortest);
    }
  }
  for (const mesh::Hexahedron& h : mesh.hexahedra) add_hexahedron(mesh, h, size);
  return size;
}

void place_free_bodies(const Case& c, mesh::Mesh& mesh, dynamics::Model& model) {
  if (model.free_bodies.empty()) return refuse_for_held_bodies(c);
  RONDO_DEMAND(model.n_nodes() == mesh.n_nodes() && model.free_body.size() == mesh.n_nodes(),
               model.n_nodes(), model.free_body.size(), mesh.n_nodes());
  const Complex turn = rotation(-c.initial.turn);
  const Vec2 position = c.initial.position;
  if (c.initial.turn == 0.0 && position == Vec2{}) return;
  for (dynamics::FreeBody& body : model.free_bodies) {
    body.center = position + turn * body.center;
    for (const int node : body.nodes)
      mesh.coordinates[at(node)] = model.reference[at(node)] =
          position + turn * mesh.coordinates[at(node)];
  }
}

std::vector<RigidMotion> motions_of(const Case& c, const mesh::Mesh& mesh,
                                    const dynamics::Model& model) {
  const Initial& initial = c.initial;
  std::vector<RigidMotion> motions(model.free_bodies.size(),
                                   {initial.velocity, initial.angular_velocity});
  std::vector<int> given(motions.size(), -1);  // place in initial.regions
  RONDO_DEMAND(initial.regions.empty() || (mesh.region.size() == mesh.cells.size() &&
                                           model.free_body.size() == mesh.n_nodes()),
               mesh.region.size(), mesh.cells.size(), model.free_body.size(), mesh.n_nodes());
  const auto keys = surface_keys(c);
  for (std::size_t k = 0; k < initial.regions.size(); ++k) {
    const NameKey& key = keys[(c.mesh ? c.regions.size() : 0) + k];
    const int region = region_of(c, mesh, key);
    bool moves = false;
    for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
      const int body = mesh.region[e] == region ? model.free_body[at(mesh.cells[e][0])] : -1;
      if (body < 0) continue;
      moves = true;
      const RigidMotion motion{initial.regions[k].velocity, initial.regions[k].angular_velocity};
      RigidMotion& of_body = motions[at(body)];
      const bool same = motion.velocity == of_body.velocity &&
                        motion.angular_velocity == of_body.angular_velocity;
      if (given[at(body)] >= 0 && !same)
        throw case_error(
            c, key.key,
            fmt::format(
                "a body is part of this surface and of \"{}\", which has a different motion",
                initial.regions[at(given[at(body)])].surface),
            "one motion for each body");
      given[at(body)] = static_cast<int>(k);
      of_body = motion;
    }
    if (!moves)
      throw case_error(c, key.key, "all bodies of this surface are held by mesh.clamped",
                       "a surface of free bodies");
  }
  return motions;
}

const std::vector<mesh::Edge>& curve_of(const Case& c, const mesh::Mesh& mesh,
                                        const std::string& key, const std::string& name) {
  std::string names;
  for (const mesh::Curve& curve : mesh.curves) {
    if (curve.name == name) return curve.edges;
    names += (names.empty() ? "" : ", ") + fmt::format("\"{}\"", curve.name);
  }
  throw case_error(c, key, "there is no curve of this name", names);
}

std::vector<ProbeSite> find_probes(const Case& c, const mesh::Mesh& mesh) {
  if (c.output.probes.empty()) return {};
  RONDO_DEMAND(!mesh.is_solid() && !mesh.cells.empty(), mesh.n_nodes(), mesh.cells.size());
  const mesh::CellGrid grid(mesh.coordinates, mesh.cells);
  std::vector<ProbeSite> sites;
  for (std::size_t k = 0; k < c.output.probes.size(); ++k) sites.push_back(find_site(c, grid, k));
  return sites;
}

}  // namespace rondo::study
