// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/plausible/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rondo/case/case_keys.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/region_sizes.hpp"

namespace rondo::study {
namespace {

constexpr double earth_gravity = 9.81;  // m/s²

double mass_of(const mesh::Mesh& mesh, const std::vector<fem::Material>& materials) {
  const std::vector<double> sizes = fem::region_sizes(mesh, materials.size());
  RONDO_DEMAND(sizes.size() == materials.size(), sizes.size(), materials.size());
  double mass = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) mass += materials[k].density * sizes[k];
  return mass;
}

bool is_small_load(double load, double weight) {
  return std::abs(load) < least_load_share * weight;
}

void warn_of_load(const std::string& key, double load, double mass, bool solid,
                  std::vector<std::string>& warnings) {
  const double weight = mass * earth_gravity;
  if (load == 0.0 || !is_small_load(load, weight)) return;
  const char* force = solid ? "N" : "N/m";
  warnings.push_back(
      fmt::format("{0} of {1:.4g} {2} is {3:.2g} times the weight of the body ({4:.3g} {5}, "
                  "{6:.3g} {2}): it hardly presses the body; is the load in {2}, not in k{2}?",
                  key, load, force, std::abs(load) / weight, mass, solid ? "kg" : "kg/m", weight));
}

void warn_of_loads(const Case& c, const mesh::Mesh& mesh,
                   const std::vector<fem::Material>& materials,
                   std::vector<std::string>& warnings) {
  const bool by_rim = c.rim && c.rim->free_y && c.motion.gravity.largest() == 0.0;
  if (!c.analysis.load && !by_rim) return;
  const double mass = mass_of(mesh, materials);
  if (c.analysis.load)
    warn_of_load("analysis.load", *c.analysis.load, mass, mesh.is_solid(), warnings);
  if (by_rim)
    warn_of_load("rim.force_y", c.rim->force_y.largest(), mass, mesh.is_solid(), warnings);
}

double softest_of(const std::vector<fem::Material>& materials) {
  double softest = std::numeric_limits<double>::infinity();
  for (const fem::Material& m : materials) softest = std::min(softest, m.youngs_modulus);
  return softest;
}

bool is_small(double pressure, double share, double softest) {
  return pressure != 0.0 && pressure < least_pressure && pressure < share * softest;
}

void warn_of_pressures(const Case& c, const std::vector<fem::Material>& materials,
                       std::vector<std::string>& warnings) {
  const double softest = softest_of(materials);
  const auto warn = [&](const std::string& key, double most) {
    warnings.push_back(
        fmt::format("{} reaches {:.4g} Pa at most, {:.2g} of the softest modulus: it hardly "
                    "deforms the body; is the pressure in Pa, not in bar or kPa?",
                    key, most, most / softest));
  };
  for (std::size_t k = 0; k < c.pressures.size(); ++k)
    if (const double most = c.pressures[k].pressure.largest();
        is_small(most, least_pressure_share, softest))
      warn(item_of("load.pressure", k) + ".value", most);
  if (is_hardly_inflated(c, materials)) warn("inflation.pressure", c.inflation->pressure);
}

void warn_of_angle(const char* key, double angle, std::vector<std::string>& warnings) {
  if (angle <= wide_angle) return;
  warnings.push_back(fmt::format(
      "{} reaches {:.4g} rad, which is {:.3g} degrees: more than tyres roll at; is the angle in "
      "rad, not in degrees?",
      key, angle, angle * 180.0 / std::numbers::pi));
}

void warn_of_turn_slip(const Case& c, const mesh::Mesh& mesh, std::vector<std::string>& warnings) {
  double radius = 0.0;
  for (const int node : mesh.boundary) radius = std::max(radius, norm(mesh.coordinates[at(node)]));
  const double turn = std::abs(c.analysis.turn_slip);
  if (turn * radius <= 1.0) return;
  warnings.push_back(
      fmt::format("motion.turn_slip: the path has a radius of {:.3g} m, less than the wheel, which "
                  "has {:.3g} m; "
                  "is the value the radius of the path, and not one over it?",
                  1.0 / turn, radius));
}

/// The tread lies to one side of the plane in which the wheel is held, turned and steered.
void warn_of_section(const Case& c, const mesh::Mesh& mesh, std::vector<std::string>& warnings) {
  if (!c.section || mesh.boundary.empty()) return;
  RONDO_DEMAND(mesh.axial.size() == mesh.n_nodes(), mesh.axial.size(), mesh.n_nodes());
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (const int node : mesh.boundary) {
    const double z = mesh.axial[at(node)];
    left = std::min(left, z);
    right = std::max(right, z);
  }
  const double middle = 0.5 * (left + right), width = right - left;
  if (std::abs(middle) <= off_middle * width) return;
  warnings.push_back(fmt::format(
      "section.file: the curve \"{}\" lies from z = {:.4g} to {:.4g} m, its middle {:.4g} m beside "
      "z = 0, the plane about which moments, slip angle and camber are taken: the wheel is offset "
      "by that; is the section drawn about its middle, and whole{}?",
      c.section->mesh.contact, left, right, std::abs(middle),
      c.inflation ? ", and does inflation.mounting move its beads to opposite sides" : ""));
}

}  // namespace

void warn_of_senses(const Case& c, const mesh::Mesh& mesh,
                    const std::vector<fem::Material>& materials,
                    std::vector<std::string>& warnings) {
  warn_of_loads(c, mesh, materials, warnings);
  warn_of_pressures(c, materials, warnings);
  warn_of_angle("motion.slip_angle", c.motion.slip_angle.largest(), warnings);
  warn_of_angle("motion.camber", std::abs(c.motion.camber), warnings);
  warn_of_turn_slip(c, mesh, warnings);
  warn_of_section(c, mesh, warnings);
}

std::string stays_above_ground(double height, double radius) {
  if (!(height - radius > clear_share * radius)) return {};
  return fmt::format(
      "motion.height: the center comes no nearer to the ground than {:.4g} m, and the body, whose "
      "radius is {:.4g} m, stays {:.4g} m above it: nothing touches; is the height in m, not in "
      "mm, and counted from y = 0 to the center?",
      height, radius, height - radius);
}

std::string starts_far_above(double height, double radius) {
  if (!(height - radius > far_share * radius)) return {};
  return fmt::format(
      "motion.height: the wheel, whose radius is {:.4g} m, starts {:.4g} m above the ground; is "
      "the height in m, not in mm, and counted from y = 0 to the center?",
      radius, height - radius);
}

bool is_hardly_loaded(double load, const mesh::Mesh& mesh,
                      const std::vector<fem::Material>& materials) {
  return is_small_load(load, mass_of(mesh, materials) * earth_gravity);
}

bool is_hardly_inflated(const Case& c, const std::vector<fem::Material>& materials) {
  return c.inflation &&
         is_small(c.inflation->pressure, least_inflation_share, softest_of(materials));
}

std::string hardly_pressed(const std::string& key, double deflection, double radius) {
  RONDO_DEMAND(radius > 0.0, radius, key);
  if (!(deflection > 0.0) || deflection >= least_deflection * radius) return {};
  return fmt::format(
      "{}: the body is pressed in by {:.3g} m, {:.2g} of its radius of {:.4g} m: hardly more than "
      "a first touch, which the mesh does not resolve; are loads in N and lengths in m?",
      key, deflection, deflection / radius, radius);
}

}  // namespace rondo::study
