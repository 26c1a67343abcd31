// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/modes/standing_wheel.hpp"

#include <fmt/format.h>

#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/solid/solid_body.hpp"
#include "rondo/analysis/build/steady_start.hpp"
#include "rondo/case/case_rules.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/steady/rolling_contact.hpp"

namespace rondo::study {
namespace {

/// Tables are taken at their ends, once the wheel is set down and inflated [s].
constexpr double at_last = 1e300;

void refuse_nonlinear(const Case& c) {
  if (!c.inflation || c.inflation->nonlinear == TyreMotion::linear) return;
  throw case_error(c, "inflation.nonlinear",
                   "--standing presses the wheel down as one that is linear about its inflated "
                   "state",
                   "\"none\"; rondo run with nonlinear cords gives the load at a height");
}

void refuse_friction_law(const Case& c) {
  if (!c.ground || c.ground->friction.is_constant()) return;
  throw case_error(c, "ground.friction",
                   "--standing takes one coefficient of friction for all contacts",
                   "a number ground.friction, and no [[ground.patch]]");
}

double ground_height(const Case& c, double radius) {
  if (!c.ground)
    throw case_error(c, "ground", "there is no ground to stand on",
                     "a [ground]; or the modes without --standing");
  if (has_obstacles_of_own_axes(c))
    throw case_error(c, ground_key(c),
                     "a wheel that stands takes obstacles of one angle, on level ground",
                     "one angle for all obstacles and ground.profile = \"flat\"");
  const std::optional<double> flat = flat_ground_below(c, radius);
  if (!flat)
    throw case_error(c, ground_key(c), "is not flat below the wheel at t = 0",
                     "another motion.start_x, or obstacles further away");
  return *flat;
}

/// Steady rolling without inertia and without friction is pressing at rest: the spin, which must
/// not be 0 there, has no influence.
statics::RollingHarmonics<3> harmonics_of(const Case& c, const mesh::Mesh& mesh,
                                          std::span<const double> mass,
                                          const fem::SolidSector& sector) {
  constexpr double any_spin = 1e-6;
  return statics::RollingHarmonics<3>(
      {.stiffness = sector,
       .mass = mass,
       .reference = mesh.coordinates,
       .axial = mesh.axial,
       .candidates = candidate_rows(mesh, sector),
       .spin = any_spin,
       .rest_spin = c.inflation && c.inflation->spin ? *c.inflation->spin : any_spin,
       .inertia = statics::RollingInertia::none,
       .load = solid_sector_load(c, mesh, sector, at_last)});
}

statics::RollingDrive drive_of(const Case& c, double ground) {
  if (c.rim && c.rim->free_y)
    throw case_error(c, "rim.free", "the height is free, and motion.height is only where it starts",
                     "a height that motion.height gives; or steady rolling, whose analysis.load "
                     "is taken");
  statics::RollingDrive drive;
  drive.load = c.analysis.load;
  drive.height = c.motion.height.at(at_last) - ground;
  return drive;
}

const char* depth_key(const Case& c) {
  return c.analysis.load ? "analysis.load" : "motion.height";
}

void refuse_within_rim(const Case& c, double height, const std::optional<Wall>& wall) {
  const double rim = wall ? wall->radius - wall->thickness : 0.0;
  if (height > rim) return;
  throw case_error(
      c, depth_key(c),
      fmt::format("the ground is within the rim: the center is {:.6g} m above it", height),
      fmt::format("a center well above {:.6g} m, the radius of the rim", rim));
}

void refuse(const Case& c, const statics::RollingSolution& found, double lowest,
            const std::optional<Wall>& wall) {
  if (found.end == statics::RollingEnd::no_contact)
    throw case_error(c, depth_key(c), "the wheel does not touch the ground",
                     fmt::format("the center less than {:.6g} m above the ground, the radius of "
                                 "the wheel{}",
                                 lowest, c.inflation ? " as it is inflated at rest" : ""));
  if (found.end != statics::RollingEnd::solved)
    throw case_error(c, depth_key(c), "the contact of the standing wheel was not solved",
                     "a larger height or a smaller load, which press it less");
  refuse_within_rim(c, found.height, wall);
}

}  // namespace

StandingWheel standing_wheel(const Case& c, const mesh::Mesh& mesh, std::span<const double> mass,
                             const fem::SolidSector& sector) {
  refuse_nonlinear(c);
  refuse_friction_law(c);
  const std::optional<Wall> wall = wall_of(mesh);
  const statics::RollingDrive drive =
      drive_of(c, ground_height(c, wall ? wall->radius : c.disk.outer_radius));
  if (!drive.load) refuse_within_rim(c, drive.height, wall);
  const statics::RollingHarmonics<3> harmonics = harmonics_of(c, mesh, mass, sector);
  statics::RollingWindow<3> window(harmonics, statics::SlipDifference::upwind, c.motion.camber,
                                   c.motion.gravity.at(at_last));
  const statics::RollingSolution found = statics::solve_rolling(window, drive);
  refuse(c, found, window.lowest(), wall);
  StandingWheel wheel;
  wheel.figures = {found.height, found.forces.normal, 0};
  const statics::NodeMatrix<3> axes = statics::ground_axes<3>(window.problem().lean);
  const bool sticks = contact::largest_friction(c.ground->friction) > 0.0;
  for (std::size_t k = 0; k < window.pairs().size(); ++k) {
    if (!(found.force[static_cast<Eigen::Index>(3 * k)] > 0.0)) continue;
    const statics::RollingPair& pair = window.pairs()[k];
    const std::size_t node = sector.node(at(harmonics.body().candidates[pair.candidate]),
                                         harmonics.wrapped(pair.sample));
    for (Eigen::Index d = 0; d < (sticks ? 3 : 1); ++d)
      wheel.held.push_back({node, {axes(0, d), axes(1, d), axes(2, d)}});
    ++wheel.figures.nodes;
  }
  return wheel;
}

}  // namespace rondo::study
