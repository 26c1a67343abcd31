// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/solid/solid_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/analysis/build/ground/contact_law.hpp"
#include "rondo/analysis/build/rim.hpp"
#include "rondo/analysis/build/tyre/inflation_members.hpp"
#include "rondo/analysis/build/tyre/wheel_at_rest.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace rondo::study {
namespace {

using dynamics::Model;

const mesh::Surface& surface_of(const Case& c, const mesh::Mesh& mesh, const std::string& key,
                                const std::string& name) {
  std::string names;
  for (const mesh::Surface& surface : mesh.surfaces) {
    if (surface.name == name) return surface;
    names += (names.empty() ? "" : ", ") + fmt::format("\"{}\"", surface.name);
  }
  throw case_error(c, key, "there is no curve of this name in the section of the wheel", names);
}

/// Refuses a surface whose nodes are all held: it feels no pressure.
void refuse_held(const Case& c, const std::string& key, const mesh::Mesh& mesh,
                 const mesh::Surface& surface) {
  const std::vector<char> held = mesh::clamped_flags(mesh);
  const bool all_held = std::ranges::all_of(surface.faces, [&](const mesh::Face& face) {
    return std::ranges::all_of(face, [&](int node) { return held[at(node)] != 0; });
  });
  if (!all_held) return;
  throw case_error(
      c, key,
      fmt::format("every node of \"{}\" is held: a pressure there has no effect", surface.name),
      c.section ? fmt::format("a curve that is not held; section.clamped = \"{}\" "
                              "holds this one",
                              fmt::join(c.section->mesh.clamped, "\", \""))
                : "\"tread\", \"left\" or \"right\"; for a tyre that is inflated a "
                  "[section] with a cavity");
}

void add_ground(const Case& c, const mesh::Mesh& mesh, Model& model) {
  if (!c.ground) return;
  const std::vector<mesh::Edge> edges =
      mesh::rolling_edges(mesh, c.section ? c.section->mesh.contact : "tread");
  model.contact.emplace(dynamics::ContactModel{
      contact::Ground(c.ground->shape, mesh::longest_edge(mesh.coordinates, edges)),
      law_of(*c.ground), mesh.boundary, mesh.tributary, edges,
      contact::EdgeAxes(c.ground->edge_angle)});
}

/// -s0² M P x, a load that is always there.
void add_pull(const WheelAtRest& rest, dynamics::SolidBody& body) {
  if (!rest.load.empty()) body.pressures.push_back({rest.load, dynamics::Table(1.0), true});
}

/// The critical step is that of this stiffness.
struct Stiffest {
  std::optional<fem::SolidSector> sector;  ///< none: that of the model
  double frequencies_below = 0.0;          ///< upper bound of ω² [1/s²]
};

Stiffest make_solid_model(const Case& c, Setup& s) {
  Model& model = s.model;
  WheelAtRest rest = wheel_at_rest(c, s.mesh, s.materials, fem::ViscousBy::branches);
  model.scheme = c.time.scheme;
  model.reference = s.mesh.coordinates;
  model.mass = std::move(rest.mass);
  model.free = fem::free_nodes(s.mesh);
  model.stiffness_operator = dynamics::StiffnessOperator::cyclic;
  model.stiffness_damping = c.damping.stiffness;
  add_rim(c, s.mesh, model);
  add_ground(c, s.mesh, model);
  dynamics::SolidBody& body = model.solid.emplace();
  body.axial = s.mesh.axial;
  body.sector = std::move(rest.sector);
  RONDO_DEMAND(model.mass.size() == model.n_nodes() && body.axial.size() == model.n_nodes() &&
                   body.sector.n_local() * static_cast<std::size_t>(body.sector.n_sectors) ==
                       model.free.size(),
               model.mass.size(), body.axial.size(), model.n_nodes(), body.sector.n_local(),
               body.sector.n_sectors, model.free.size());
  add_solid_pressures(c, s.mesh, body);
  add_pull(rest, body);
  body.swept = std::move(rest.swept);
  body.viscous = std::move(rest.viscous);
  s.inflation = std::move(rest.inflation);
  return {std::move(rest.stiffest), rest.frequencies_below};
}

/// The rim moves in its plane: what it feels of K is that of no axial displacement.
dynamics::CriticalStep step_with_solid_rim(const Model& model, const fem::SolidSector& sector,
                                           const dynamics::CriticalStep& held,
                                           dynamics::LaggedDamping damping) {
  std::vector<Vec3> in_space(model.n_nodes()), force(model.n_nodes());
  const auto product = [&](std::span<const Vec2> u, std::span<Vec2> out) {
    std::ranges::transform(u, in_space.begin(), [](Vec2 a) { return Vec3(a, 0.0); });
    fem::apply(sector, in_space, force);
    std::ranges::transform(force, out.begin(), &Vec3::plane);
  };
  return step_with_rim(model, product, held, damping);
}

void find_solid_step(const Case& c, const Stiffest& stiffest, Setup& s) {
  const Model& m = s.model;
  const dynamics::LaggedDamping damping{c.damping.stiffness, c.rim ? c.damping.mass : 0.0};
  const fem::SolidSector& sector = stiffest.sector ? *stiffest.sector : m.solid->sector;
  const dynamics::CriticalStep held =
      dynamics::critical_step(sector, m.mass, damping, stiffest.frequencies_below);
  s.critical_plain = held.step;
  s.critical = m.rim ? step_with_solid_rim(m, sector, held, damping) : held;
}

std::string range_text(const dynamics::Table& table) {
  double low = table.at(0.0), high = low;
  for (const auto& point : table.points()) {
    low = std::min(low, point[1]);
    high = std::max(high, point[1]);
  }
  constexpr double degrees = 57.29577951308232;
  if (low == high) return fmt::format("{:.4g} rad ({:.4g}°)", low, degrees * low);
  return fmt::format("{:.4g} to {:.4g} rad ({:.4g} to {:.4g}°)", low, high, degrees * low,
                     degrees * high);
}

std::string motion_text(const dynamics::SweptPart& part) {
  if (!part.rubber) return "cords and air nonlinear, rubber linear about the state";
  if (part.window.is_whole()) return "cords, air and rubber nonlinear";
  return fmt::format(
      "cords and air nonlinear, rubber within {:.4g} rad ({:.4g}°) of the lowest point, else "
      "linear about the state",
      part.window.half, 180.0 / std::numbers::pi * part.window.half);
}

}  // namespace

void add_solid_pressures(const Case& c, const mesh::Mesh& mesh, dynamics::SolidBody& body) {
  RONDO_DEMAND(body.sector.n_local() > 0 && mesh.is_solid(), body.sector.n_local());
  for (std::size_t k = 0; k < c.pressures.size(); ++k) {
    const std::string key = item_of("load.pressure", k) + ".curve";
    const mesh::Surface& surface = surface_of(c, mesh, key, c.pressures[k].curve);
    refuse_held(c, key, mesh, surface);
    body.pressures.push_back(
        {fem::sector_pressure(mesh, body.sector, surface.faces), c.pressures[k].pressure});
  }
}

std::vector<Vec3> solid_sector_load(const Case& c, const mesh::Mesh& mesh,
                                    const fem::SolidSector& sector, double time) {
  if (c.pressures.empty()) return {};
  dynamics::SolidBody body;
  body.sector = sector;
  add_solid_pressures(c, mesh, body);
  std::vector<Vec3> load(sector.n_local());
  for (const dynamics::SolidPressure& p : body.pressures)
    for (std::size_t a = 0; a < load.size(); ++a) load[a] += p.pressure.at(time) * p.force[a];
  return load;
}

void make_solid_body(const Case& c, int threads, Setup& s) {
  RONDO_DEMAND(s.mesh.is_solid() && !s.materials.empty(), s.mesh.n_nodes(), s.materials.size());
  const Stiffest stiffest = make_solid_model(c, s);
  choose_threads(s, threads);
  find_solid_step(c, stiffest, s);
}

std::vector<Vec3> solid_positions(const Setup& s) {
  const Model& m = s.model;
  const GroundFrame ground(m.motion.camber);
  const Vec3 center = m.motion.center(0.0);
  const std::span<const Vec3> u = s.displacement.space();
  RONDO_DEMAND(m.solid && u.size() == m.n_nodes(), u.size(), m.n_nodes());
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < u.size(); ++k)
    x.push_back(center + ground.from_wheel(Vec3(m.reference[k], m.solid->axial[k]) + u[k]));
  return x;
}

double width_of(const mesh::Mesh& mesh) {
  RONDO_DEMAND(mesh.is_solid(), mesh.n_nodes());
  const auto [left, right] = std::ranges::minmax(mesh.axial);
  return right - left;
}

void tell_solid_figures(const Case& c, Setup& s) {
  RONDO_DEMAND(s.model.solid.has_value(), s.mesh.n_sectors);
  const std::size_t local = s.model.solid->sector.n_local();
  s.figures.emplace_back("wheel", fmt::format("{} sectors of {} dofs, {:.6g} m wide",
                                              s.mesh.n_sectors, 3 * local, width_of(s.mesh)));
  if (s.inflation)
    for (Told& line : told_of(*s.inflation)) s.figures.push_back(std::move(line));
  if (s.model.solid->swept) s.figures.emplace_back("motion", motion_text(*s.model.solid->swept));
  if (c.motion.slip_angle.largest() != 0.0)
    s.figures.emplace_back("slip angle", range_text(c.motion.slip_angle));
  if (c.motion.camber != 0.0)
    s.figures.emplace_back("camber", range_text(dynamics::Table(c.motion.camber)));
}

}  // namespace rondo::study
