// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/physical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/plausible/plausible.hpp"
#include "rondo/analysis/build/rim.hpp"
#include "rondo/analysis/build/rubber.hpp"
#include "rondo/analysis/build/tyre/pressed_tyre.hpp"
#include "rondo/analysis/build/viscosity_lines.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::study {
namespace {

constexpr const char* si = "are the units m, kg, s, Pa, rad/s?";

struct Extremes {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Visits t = 0, the end, the points of the tables and times between.
template <class Visit>
void each_time(const Case& c, Visit&& visit) {
  constexpr int parts = 500;
  for (int k = 0; k <= parts; ++k) visit(c.time.end * k / parts);
  for (const auto* table :
       {&c.motion.angular_velocity, &c.motion.speed, &c.motion.height, &c.motion.slip_angle})
    for (const auto& [time, value] : table->points())
      if (time > 0.0 && time < c.time.end) visit(time);
}

const char* order_of(double modulus) {
  if (modulus < soft_modulus) return "softer than gels";
  if (modulus < 1e6) return "as gels and soft foams";
  if (modulus < 1e8) return "as rubber";
  if (modulus < 5e9) return "as leather and plastics";
  if (modulus < 5e10) return "as wood, stone and glass";
  return modulus < 1e12 ? "as metals" : "stiffer than any metal";
}

struct Tell {
  std::vector<Told>& figures;
  std::vector<std::string>& warnings;

  void warn(std::string text) const {
    if (!text.empty()) warnings.push_back(std::move(text));
  }
  void add(PhysicalFigures told) const {
    std::ranges::move(told.figures, std::back_inserter(figures));
    std::ranges::move(told.warnings, std::back_inserter(warnings));
  }
};

/// The body stays above the ground. @param gap >= 0 [m]
void tell_gap(double gap, const Wall& wall, const Tell& to) {
  to.figures.emplace_back("deflection", fmt::format("none: {:.4g} m above the ground", gap));
  to.warn(stays_above_ground(wall.radius + gap, wall.radius));
}

/// About how hard a wall is pressed, over E: as a layer on a rim, 1/(1 - ν²) times its deflection
/// over its thickness.
double pressure_over_modulus(double deflection, const Wall& wall, const fem::Material& m) {
  return deflection / wall.thickness / (1.0 - m.poissons_ratio * m.poissons_ratio);
}

/// Tells how far the wall of a round body on a rim, between what is held and what may touch, is
/// pressed in, and about how hard.
/// @param key that says how far
void tell_deflection(const std::string& key, double deflection, const Wall& wall,
                     const fem::Material& m, const Tell& to) {
  if (!(deflection > 0.0)) return tell_gap(-deflection, wall, to);
  to.warn(hardly_pressed(key, deflection, wall.radius));
  const double share = deflection / wall.thickness;
  const double of_modulus = pressure_over_modulus(deflection, wall, m);
  to.figures.emplace_back("deflection",
                          fmt::format("{:.4g} m, {:.3g} % of the {:.4g} m of the wall", deflection,
                                      100.0 * share, wall.thickness));
  to.figures.emplace_back(
      "contact pressure",
      fmt::format("about {:.2g} Pa, {:.2g} of E", of_modulus * m.youngs_modulus, of_modulus));
  if (share > deep_share && !m.rubber)
    to.warnings.push_back(
        fmt::format("the rim comes down by {:.4g} m, {:.3g} % of the {:.4g} m between it and the "
                    "ground at first touch, with a pressure of about {:.2g} of E: the law of the "
                    "material is for small strains",
                    deflection, 100.0 * share, wall.thickness, of_modulus));
}

/// Tells how far a tyre is pressed in, and about how hard, by its air instead of a layer.
void tell_deflection(const std::string& key, double deflection, const PressedTyre& tyre,
                     double lean, const Tell& to) {
  if (deflection > 0.0) {
    to.warn(hardly_pressed(key, deflection, tyre.wall.radius));
    return to.add(pressed_in(key, deflection, tyre));
  }
  tell_gap(-deflection, tyre.wall, to);
  to.warn(stays_clear(key, -deflection, lean, tyre));
}

/// Tells what a given load does to a tyre, unless load or pressure is warned of.
void tell_load(const Case& c, const std::string& key, double load, const RoundBody& body,
               const Wall& wall, const Tell& to) {
  if (!body.inflation || !(air_force(*body.inflation) > 0.0) || !(load > 0.0)) return;
  if (is_hardly_loaded(load, body.mesh, body.materials)) return;
  if (!is_hardly_inflated(c, body.materials))
    to.add(under_load(key, load, {*body.inflation, wall}));
}

void tell_slip(const Case& c, double radius, const Tell& to) {
  Extremes slip, both_move;
  each_time(c, [&](double t) {
    const double rim = c.motion.angular_velocity.at(t) * radius, speed = c.motion.ahead(t);
    const double ratio = dynamics::slip_ratio(rim, speed);
    slip.take(ratio);
    if (rim != 0.0 && speed != 0.0) both_move.take(ratio);
  });
  const bool is_given = !c.rim || !(c.rim->free_x || c.rim->free_spin);
  to.figures.emplace_back(is_given ? "slip ratio" : "slip at t = 0",
                          slip.low == slip.high
                              ? fmt::format("{:.3g}", slip.low + 0.0)
                              : fmt::format("{:.3g} to {:.3g}", slip.low, slip.high));
  const double worst = std::max(both_move.high, -both_move.low);
  if (worst > wide_slip && is_given)
    to.warnings.push_back(
        fmt::format("the slip ratio is {:.3g}: motion.angular_velocity times the radius of {:.4g} "
                    "m is far from motion.speed; {}",
                    both_move.high == worst ? both_move.high : both_move.low, radius, si));
}

/// Largest speed of the free nodes at the start, and of the rim [m/s].
double fastest(const Case& c, const Setup& s, double radius) {
  double speed = 0.0;
  for (const int node : s.model.free)
    speed = std::max(speed, initial_speed(s, static_cast<std::size_t>(node)));
  double rim = 0.0;
  if (is_held(c))
    each_time(c, [&](double t) {
      rim = std::max({rim, std::abs(c.motion.angular_velocity.at(t)) * radius,
                      std::abs(c.motion.speed.at(t))});
    });
  return speed + rim;
}

void tell_speed(const Case& c, double speed, const std::vector<fem::Material>& materials,
                const Tell& to) {
  double shear = std::numeric_limits<double>::infinity(), of_linear = shear;  // the slowest
  for (const fem::Material& m : materials) {
    shear = std::min(shear, fem::wave_speeds(m).shear);
    if (!m.rubber && !c.inflation) of_linear = std::min(of_linear, fem::wave_speeds(m).shear);
  }
  to.figures.emplace_back("speed", fmt::format("{:.4g} m/s, {:.2g} of the shear wave ({:.4g} m/s)",
                                               speed, speed / shear, shear));
  const double share = speed / of_linear;
  if (share > fast_share)
    to.warnings.push_back(
        fmt::format("{:.4g} m/s is {:.3g} times the speed of shear waves ({:.4g} m/s): strains are "
                    "of about that size, and the law of the material is for small ones; {}",
                    speed, share, of_linear, si));
}

void tell_stiffness(const std::vector<fem::Material>& materials, const Tell& to) {
  Extremes e;
  for (const fem::Material& m : materials) e.take(m.youngs_modulus);
  const auto text = [](double modulus) {
    return fmt::format("E = {:.3g} Pa, {}", modulus, order_of(modulus));
  };
  to.figures.emplace_back("stiffness",
                          e.low == e.high ? text(e.low) : text(e.low) + "; to " + text(e.high));
}

void tell_materials(const Case& c, const std::vector<fem::Material>& materials, const Tell& to) {
  tell_stiffness(materials, to);
  std::ranges::move(viscosity_lines(c), std::back_inserter(to.figures));
}

/// Most that the center comes down below first touch; < 0: how far it stays above [m].
double deflection_by_motion(const Case& c, const Setup& s, const Wall& wall) {
  double deflection = -std::numeric_limits<double>::infinity();
  each_time(c, [&](double t) {
    const double gap = dynamics::distance_in_space(*s.model.contact, c.motion.center(t));
    deflection = std::max(deflection, wall.radius - gap);
  });
  return deflection;
}

/// The softest of what may touch.
const fem::Material& touching_material(const mesh::Mesh& mesh,
                                       const std::vector<fem::Material>& materials) {
  RONDO_DEMAND(!mesh.boundary.empty() && !materials.empty(), materials.size());
  std::vector<char> touches(mesh.n_nodes(), 0);
  for (const int node : mesh.boundary) touches[at(node)] = 1;
  double least = std::numeric_limits<double>::infinity();
  std::size_t softest = 0;
  const auto add = [&](std::size_t e, std::span<const int> corners) {
    const double modulus = fem::material_of(mesh, materials, e).youngs_modulus;
    if (modulus >= least) return;
    for (const int node : corners) {
      if (!touches[at(node)]) continue;
      least = modulus;
      softest = e;
    }
  };
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    add(e,
        std::span(mesh.cells[e]).first(static_cast<std::size_t>(mesh::n_corners(mesh.cells[e]))));
  for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e) add(e, mesh.hexahedra[e]);
  RONDO_ASSERT(std::isfinite(least), least, mesh.boundary.size());  // candidates are in cells
  return fem::material_of(mesh, materials, softest);
}

/// By the height of the rim.
void tell_height(const Case& c, double deflection, const RoundBody& body, const Wall& wall,
                 const Tell& to) {
  constexpr const char* key = "motion.height";
  if (body.inflation)
    tell_deflection(key, deflection, {*body.inflation, wall}, c.motion.camber, to);
  else
    tell_deflection(key, deflection, wall, touching_material(body.mesh, body.materials), to);
}

/// How deep a rim comes that forces move, the run looks (HubWatch).
void tell_free_height(const Case& c, const Setup& s, const Wall& wall, const Tell& to) {
  const double start = dynamics::distance_in_space(*s.model.contact, c.motion.center(0.0));
  to.warn(starts_far_above(start, wall.radius));
  if (const std::optional<double> load = load_on_ground(c, s.model))
    tell_load(c, "rim.force_y", *load, {s.mesh, s.materials, s.inflation}, wall, to);
}

}  // namespace

void warn_of_units(const Case& c, const mesh::Mesh& mesh,
                   const std::vector<fem::Material>& materials,
                   std::vector<std::string>& warnings) {
  for (const fem::Material& m : materials) {
    const double e = m.youngs_modulus, density = m.density, sound = std::sqrt(e / density);
    const bool light = density < least_density && e >= soft_modulus;
    if (sound >= slow_sound && sound <= fast_sound && !light && density <= largest_density)
      continue;
    warnings.push_back(
        fmt::format("a material with E = {:.3g} Pa and a density of {:.3g} kg/m3, in which waves "
                    "travel at {:.3g} m/s, is {}; {}",
                    e, density, sound,
                    light                       ? "lighter than foams"
                    : density > largest_density ? "heavier than any metal"
                    : sound < slow_sound        ? "softer than gels"
                                                : "stiffer than diamond",
                    si));
    break;  // the same slip in all of them
  }
  const double size = extent_of(mesh);
  if (size > largest_size || size < least_size)
    warnings.push_back(fmt::format("the body is {:.3g} m long: are {} in metres?", 2.0 * size,
                                   c.mesh      ? "the lengths of the mesh (mesh.scale)"
                                   : c.section ? "the lengths of the section (section.scale)"
                                               : "the radii"));
}

std::optional<Wall> wall_of(const mesh::Mesh& mesh) {
  constexpr double round = 0.9;
  if (mesh.clamped.empty() || mesh.boundary.empty()) return std::nullopt;
  const auto radius = [&](int node) { return norm(mesh.coordinates[at(node)]); };
  Extremes outer, inner;
  for (const int node : mesh.boundary) outer.take(radius(node));
  for (const int node : mesh.clamped) inner.take(radius(node));
  if (outer.low < round * outer.high || inner.high >= outer.low) return std::nullopt;
  return Wall{outer.high, outer.high - inner.high};
}

std::optional<double> estimated_pressure(const Case& c, const Setup& s) {
  if (!is_held(c) || !s.model.contact || s.inflation || (s.model.rim && s.model.rim->free_y))
    return std::nullopt;
  const std::optional<Wall> wall = wall_of(s.mesh);
  const double deflection = wall ? deflection_by_motion(c, s, *wall) : 0.0;
  if (!(deflection > 0.0)) return std::nullopt;
  const fem::Material& m = touching_material(s.mesh, s.materials);
  return m.youngs_modulus * pressure_over_modulus(deflection, *wall, m);
}

void tell_physical_figures(const Case& c, Setup& s) {
  RONDO_DEMAND(s.velocity.size() == s.model.n_nodes(), s.velocity.size(), s.model.n_nodes());
  const Tell to{s.figures, s.warnings};
  warn_of_senses(c, s.mesh, s.materials, s.warnings);
  tell_materials(c, s.materials, to);
  for (Told& told : rubber_lines(c, explicit_step(s.model))) s.figures.push_back(std::move(told));
  const std::optional<Wall> wall = is_held(c) ? wall_of(s.mesh) : std::nullopt;
  if (has_candidates(s.model))  // alone in space only spin strains: see the check of softening
    tell_speed(c, fastest(c, s, wall ? wall->radius : extent_of(s.mesh)), s.materials, to);
  if (s.model.rim) tell_rim(c, s);
  if (!wall || !s.model.contact) return;
  if (s.model.rim && s.model.rim->free_y)
    tell_free_height(c, s, *wall, to);
  else
    tell_height(c, deflection_by_motion(c, s, *wall), {s.mesh, s.materials, s.inflation}, *wall,
                to);
  tell_slip(c, wall->radius, to);
}

void tell_physical_figures(const Case& c, CrushSetup& s) {
  const Tell to{s.figures, s.warnings};
  warn_of_units(c, s.mesh, s.materials, s.warnings);
  warn_of_senses(c, s.mesh, s.materials, s.warnings);
  tell_materials(c, s.materials, to);
  for (Told& told : rubber_lines(c, 0.0)) s.figures.push_back(std::move(told));
  if (const std::optional<Wall> wall = wall_of(s.mesh))
    tell_deflection("analysis.depth", s.path.largest_depth(), *wall,
                    touching_material(s.mesh, s.materials), to);
}

void tell_physical_figures(const Case& c, const RoundBody& body, PhysicalFigures& told) {
  const Tell to{told.figures, told.warnings};
  warn_of_senses(c, body.mesh, body.materials, told.warnings);
  tell_materials(c, body.materials, to);
  const std::optional<Wall> wall = wall_of(body.mesh);
  const double radius = wall ? wall->radius : extent_of(body.mesh);
  const bool finds_speed = c.analysis.traction || c.analysis.torque;
  const double rim = std::abs(c.motion.angular_velocity.at(0.0)) * radius;
  tell_speed(c, finds_speed ? rim : std::max(rim, std::abs(c.motion.speed.at(0.0))), body.materials,
             to);
  if (!wall) return;
  if (c.analysis.load) {
    tell_load(c, "analysis.load", *c.analysis.load, body, *wall, to);
  } else {
    RONDO_DEMAND(c.ground.has_value(), c.file.string());
    const double height = c.motion.height.at(0.0) - c.ground->shape.profile.front().y;
    tell_height(c, wall->radius - height, body, *wall, to);
  }
  if (!finds_speed) tell_slip(c, wall->radius, to);
}

void tell_physical_figures(const Case& c, const RoundBody& body, const CrushPath& path,
                           PhysicalFigures& told) {
  constexpr const char* key = "analysis.depth";
  const Tell to{told.figures, told.warnings};
  warn_of_senses(c, body.mesh, body.materials, told.warnings);
  tell_materials(c, body.materials, to);
  const std::optional<Wall> wall = wall_of(body.mesh);
  if (!wall) return;
  if (path.has_load())
    tell_load(c, "analysis.load", *c.analysis.load, body, *wall, to);
  else if (body.inflation)
    tell_deflection(key, path.largest_depth(), {*body.inflation, *wall}, c.motion.camber, to);
  else
    tell_deflection(key, path.largest_depth(), *wall, touching_material(body.mesh, body.materials),
                    to);
}

}  // namespace rondo::study
