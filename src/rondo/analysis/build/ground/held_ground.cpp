// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/ground/held_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::study {
namespace {

/// Share of the extent of the body: a smaller depth is round-off of nodes that touch the ground.
constexpr double touching = 1e-6;

Vec2 place_of(const mesh::Mesh& mesh, int node) {
  return mesh.coordinates[at(node)];
}

/// Whether what is held is farther out than what may touch: then the two are rather swapped.
bool is_outside(const mesh::Mesh& mesh) {
  const auto farthest = [&](const std::vector<int>& nodes) {
    double most = 0.0;
    for (const int node : nodes) most = std::max(most, norm(place_of(mesh, node)));
    return most;
  };
  return farthest(mesh.clamped) > farthest(mesh.boundary);
}

std::string swapped(const Case& c, const MeshCase& file) {
  const std::string table = c.mesh ? "mesh" : "section";
  return fmt::format(
      "the held nodes are farther from the center than those that may touch: should \"{}\" be "
      "{}.contact and \"{}\" {}.clamped?",
      fmt::join(file.clamped, "\", \""), table, file.contact, table);
}

[[noreturn]] void refuse(const Case& c, const mesh::Mesh& mesh, double depth,
                         const std::string& when) {
  const MeshCase* const file = mesh_file_of(c);
  const std::string key(file && c.mesh ? "mesh.clamped"
                        : file         ? "section.clamped"
                                       : rules_of(c.analysis.kind).height_key);
  std::string allowed = "a body whose held nodes stay above the ground";
  if (file && is_outside(mesh)) allowed += "; " + swapped(c, *file);
  throw case_error(c, key,
                   fmt::format("{}nodes that are held would be up to {:.4g} m deep in the ground, "
                               "which exerts no forces on them",
                               when, depth),
                   allowed);
}

/// How deep held nodes are at a time [m].
double depth_at(const Setup& s, double reach, double time) {
  const contact::Ground& ground = s.model.contact->ground;
  const Vec3 axle = s.model.motion.center(time);
  const Vec2 center = axle.plane();
  const double above = dynamics::distance_in_space(*s.model.contact, axle);
  if (s.mesh.is_solid() || above >= reach) return reach - above;
  const double angle = s.model.motion.angle(time);
  const Complex turn{std::cos(angle), std::sin(angle)};
  double depth = -reach;
  for (const int node : s.mesh.clamped)
    depth = std::max(depth, -ground.distance(center + turn * place_of(s.mesh, node)));
  return depth;
}

}  // namespace

double held_reach(const mesh::Mesh& mesh, double camber) {
  double reach = 0.0;
  for (const int node : mesh.clamped) {
    const double radius = norm(place_of(mesh, node));
    const double axial = mesh.is_solid() ? mesh.axial[at(node)] : 0.0;
    reach = std::max(reach, -GroundFrame(camber).from_wheel({0.0, -radius, axial}).y);
  }
  return reach;
}

double held_radius(const mesh::Mesh& mesh) {
  constexpr double round = 0.9;
  double least = 0.0, most = 0.0;
  for (const int node : mesh.clamped) {
    const double radius = norm(place_of(mesh, node));
    least = most == 0.0 ? radius : std::min(least, radius);
    most = std::max(most, radius);
  }
  return least >= round * most ? most : 0.0;
}

void refuse_held_in_ground(const Case& c, const Setup& s) {
  if (s.mesh.clamped.empty() || !s.model.contact) return;
  constexpr int parts = 500;
  const double reach = held_reach(s.mesh, s.model.motion.camber);
  const double close = touching * extent_of(s.mesh);
  double deepest = depth_at(s, reach, 0.0), when = 0.0;
  const bool follows_tables = !s.model.rim || !(s.model.rim->free_x || s.model.rim->free_y);
  const auto look = [&](double time) {
    const double depth = depth_at(s, reach, time);
    if (depth > deepest) deepest = depth, when = time;
  };
  if (follows_tables) {
    for (int k = 1; k <= parts; ++k) look(c.time.end * k / parts);
    for (const auto& [time, value] : c.motion.height.points())
      if (time > 0.0 && time < c.time.end) look(time);
  }
  if (deepest > close) refuse(c, s.mesh, deepest, fmt::format("at t = {:.6g} s ", when));
}

std::string held_outside_contact(const Case& c, const Setup& s) {
  const MeshCase* const file = mesh_file_of(c);
  const bool moved = s.model.rim && (s.model.rim->free_x || s.model.rim->free_y);
  if (!file || !moved || !s.model.contact || s.mesh.clamped.empty() || !is_outside(s.mesh))
    return {};
  return swapped(c, *file);
}

void refuse_held_in_ground(const Case& c, const CrushSetup& s) {
  RONDO_DEMAND(s.reach > 0.0, s.reach);  // by build_crush()
  double lowest = s.touch_height;
  for (const int node : s.mesh.clamped)
    lowest = std::min(lowest, s.touch_height + place_of(s.mesh, node).y);
  const double depth = s.path.largest_depth() - lowest;
  if (depth > touching * extent_of(s.mesh)) refuse(c, s.mesh, depth, "at the largest depth ");
}

void refuse_held_in_ground(const Case& c, const mesh::Mesh& mesh, const CrushPath& path,
                           double touch_height) {
  if (path.has_load() || mesh.clamped.empty()) return;
  const double depth = held_reach(mesh, c.motion.camber) - touch_height + path.largest_depth();
  if (depth > touching * extent_of(mesh)) refuse(c, mesh, depth, "at the largest depth ");
}

void refuse_held_in_ground(const Case& c, const mesh::Mesh& mesh) {
  if (c.analysis.load || mesh.clamped.empty()) return;
  RONDO_DEMAND(c.ground && !c.ground->shape.profile.empty(), c.ground.has_value());
  const double height = c.motion.height.at(0.0) - c.ground->shape.profile.front().y;
  const double depth = held_reach(mesh, c.motion.camber) - height;
  if (depth > touching * extent_of(mesh)) refuse(c, mesh, depth, "");
}

}  // namespace rondo::study
