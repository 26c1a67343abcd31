// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/modes/standing_wheel.hpp"

#include <fmt/format.h>

#include "rondo/analysis/build/steady_start.hpp"
#include "rondo/case/case_rules.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/steady/rolling_contact.hpp"

namespace rondo::study {
namespace {

double ground_height(const Case& c) {
  if (!c.ground)
    throw case_error(c, "ground", "there is no ground to stand on",
                     "a [ground]; or the modes without --standing");
  const std::optional<double> flat = flat_ground_below(c);
  if (!flat)
    throw case_error(c, "ground.profile", "is not flat below the wheel at t = 0",
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
       .inertia = statics::RollingInertia::none});
}

}  // namespace

StandingWheel standing_wheel(const Case& c, const mesh::Mesh& mesh, std::span<const double> mass,
                             const fem::SolidSector& sector) {
  const double height = c.motion.height.points().back()[1] - ground_height(c);
  const statics::RollingHarmonics<3> harmonics = harmonics_of(c, mesh, mass, sector);
  statics::RollingWindow<3> window(harmonics, statics::SlipDifference::upwind, c.motion.camber);
  statics::RollingDrive drive;
  drive.height = height;
  const statics::RollingSolution found = statics::solve_rolling(window, drive);
  if (found.end == statics::RollingEnd::no_contact)
    throw case_error(
        c, "motion.height",
        fmt::format("nothing touches: the center is {:.6g} m above the ground", height),
        fmt::format("less than {:.6g} m above the ground", window.lowest()));
  if (found.end != statics::RollingEnd::solved)
    throw case_error(c, "motion.height", "the contact of the standing wheel was not solved",
                     "a larger height, which presses it less");
  StandingWheel wheel;
  wheel.figures = {height, found.forces.normal, 0};
  const statics::NodeMatrix<3> axes = statics::ground_axes<3>(window.problem().lean);
  const bool sticks = c.ground->friction > 0.0;
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
