// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/steady_start.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "rondo/analysis/build/ground/rolling_law.hpp"
#include "rondo/case/case_rules.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/pressure.hpp"
#include "rondo/statics/steady/rolling_newton.hpp"
#include "rondo/statics/steady/rolling_power.hpp"

namespace rondo::study {
namespace {

using RollingHarmonics = statics::RollingHarmonics<2>;

/// Samples of a column's pass: as rough as a run, whose nodes come down one by one.
constexpr int samples_of_a_column = 4;

/// At t = 0, counter-clockwise.
double spin_of(const dynamics::Model& m) {
  return -m.motion.angular_velocity.at(0.0);
}

int samples_of(const mesh::Disk& disk) {
  return samples_of_a_column *
         (disk.tread ? disk.tread->land_columns + disk.tread->groove_columns : 1);
}

RollingHarmonics harmonics_of(const Case& c, const Setup& s) {
  const dynamics::Model& m = s.model;
  RONDO_DEMAND(m.sector && m.contact && m.dt > 0.0, m.sector.has_value(), m.contact.has_value(),
               m.dt);
  return RollingHarmonics({.stiffness = *m.sector,
                           .mass = m.mass,
                           .reference = m.reference,
                           .candidates = candidate_rows(s.mesh, *m.sector),
                           .spin = spin_of(m),
                           .mass_damping = m.mass_damping,
                           .stiffness_damping = m.stiffness_damping,
                           .samples = samples_of(c.disk),
                           .massless = true,
                           .load = sector_load(m, *m.sector)});
}

void refuse(const Case& c, const statics::RollingSolution& found, double height) {
  if (found.end == statics::RollingEnd::no_contact)
    throw case_error(
        c, "motion.height",
        fmt::format("nothing touches: the center is {:.6g} m above the ground, and a start in "
                    "steady rolling presses the body down",
                    height),
        fmt::format("less than the outer radius as deformed by the spin, about {:.6g} m above the "
                    "ground; or initial.state = \"stationary\"",
                    c.disk.outer_radius));
  if (found.end != statics::RollingEnd::solved)
    throw case_error(c, "initial.state",
                     fmt::format("no steady rolling was found to start in: residual {:.3g}, bound "
                                 "{:.0e}, after {} Newton steps and {} pivots",
                                 found.residual, statics::rolling_residual_bound,
                                 found.effort.newton_steps, found.effort.pivots) +
                         (found.friction.solved ? "" : ", and the friction did not settle"),
                     "a smaller ground.friction, another motion.height; or \"stationary\" and a "
                     "run long enough to settle");
}

/// (n) Of all sectors while sector 0 is where it is in the reference.
std::vector<Vec2> nodal(const Setup& s, const Eigen::MatrixXd& of_samples, double factor) {
  const fem::SectorStiffness& sector = *s.model.sector;
  RONDO_DEMAND(of_samples.rows() == 2 * static_cast<Eigen::Index>(sector.n_local()) &&
                   of_samples.cols() > 0 && of_samples.cols() % sector.n_sectors == 0,
               of_samples.rows(), sector.n_local(), of_samples.cols(), sector.n_sectors);
  const Eigen::Index samples = of_samples.cols() / sector.n_sectors;
  std::vector<Vec2> field(s.model.n_nodes());
  for (std::size_t j = 0; j < static_cast<std::size_t>(sector.n_sectors); ++j)
    for (std::size_t a = 0; a < sector.n_local(); ++a) {
      const auto row = static_cast<Eigen::Index>(2 * a);
      const auto m = static_cast<Eigen::Index>(j) * samples;
      field[sector.node(a, j)] =
          factor * (sector.turn[j] * Vec2{of_samples(row, m), of_samples(row + 1, m)});
    }
  return field;
}

/// Keeps what touches on the ground in the first step: between its samples the sum of harmonics
/// leaves it by so much that a run would take it for free, and let it go for a step.
void hold_down(double radius, Setup& s) {
  const dynamics::Model& m = s.model;
  const contact::Ground& ground = m.contact->ground;
  const Vec2 center = m.motion.center(0.0).plane(),
             next = center + m.motion.advance(0.0, m.dt).plane();
  const Complex turned = rotation(m.motion.turn(0.0, m.dt));
  const double closed = 1e-9 * radius, depth = 1e-12 * radius;
  RONDO_DEMAND(s.half_velocity.size() == m.n_nodes() && s.displacement.size() == m.n_nodes(),
               s.half_velocity.size(), s.displacement.size(), m.n_nodes());
  const std::span<const Vec2> u = s.displacement;
  const std::span<Vec2> half = s.half_velocity;
  for (const int node : m.contact->nodes) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 arm = m.reference[k] + u[k];
    if (std::abs(ground.distance(center + arm)) > closed) continue;
    const double gap = ground.distance(next + turned * (arm + m.dt * half[k]));
    half[k] -= conj(turned) * Vec2{0.0, (gap + depth) / m.dt};
  }
}

}  // namespace

template <int C>
std::vector<int> candidate_rows(const mesh::Mesh& mesh, const fem::SectorBlocks<C>& sector) {
  std::vector<char> touches(mesh.n_nodes(), 0);
  for (const int node : mesh.boundary) touches[at(node)] = 1;
  std::vector<int> rows;
  for (std::size_t a = 0; a < sector.n_local(); ++a)
    if (touches[sector.node(a, 0)] != 0) rows.push_back(static_cast<int>(a));
  return rows;
}
template std::vector<int> candidate_rows(const mesh::Mesh&, const fem::SectorBlocks<2>&);
template std::vector<int> candidate_rows(const mesh::Mesh&, const fem::SectorBlocks<3>&);

std::vector<Vec2> sector_load(const dynamics::Model& model, const fem::SectorStiffness& sector) {
  if (model.pressures.empty()) return {};
  std::vector<Vec2> of_node(model.n_nodes());
  for (const dynamics::NodalLoad& load : dynamics::nodal_loads(model))
    of_node[at(load.node)] += model.pressures[at(load.load)].pressure.at(0.0) * load.force;
  std::vector<Vec2> rows;
  RONDO_DEMAND(sector.n_local() > 0 && sector.node(sector.n_local() - 1, 0) < model.n_nodes(),
               sector.n_local(), model.n_nodes());
  for (std::size_t a = 0; a < sector.n_local(); ++a) rows.push_back(of_node[sector.node(a, 0)]);
  return rows;
}

void set_steady_rolling(const Case& c, Setup& s) {
  const dynamics::Model& m = s.model;
  const RollingHarmonics harmonics = harmonics_of(c, s);
  statics::RollingWindow<2> window(harmonics, statics::SlipDifference::bdf2, 0.0,
                                   m.motion.gravity.at(0.0));
  const double floor = flat_ground_below(c, c.disk.outer_radius).value();
  statics::RollingDrive drive;
  drive.height = m.motion.height.at(0.0) - floor;
  drive.speed = m.motion.speed.at(0.0);
  drive.friction = constant_part(c.ground->friction);
  const std::optional<statics::RollingFriction> law = rolling_friction_of(
      c.ground->friction, extents_of<2>(s.mesh, *m.sector, harmonics.body().candidates));
  if (law) drive.law = &*law;
  const statics::RollingSolution found = solve_rolling(window, drive);
  refuse(c, found, drive.height);
  const Eigen::MatrixXcd spectrum = spectrum_of(window, found);
  const double spin = spin_of(m), half = 0.5 * spin * m.dt;
  s.displacement = nodal(s, harmonics.fields(spectrum, 0.0, false), 1.0);
  s.velocity = nodal(s, harmonics.fields(spectrum, 0.0, true), spin);
  s.half_velocity = nodal(s, harmonics.fields(spectrum, half, true), spin);
  hold_down(c.disk.outer_radius, s);
  s.figures.emplace_back(
      "start", fmt::format("steady rolling: F_x {:.6g}, F_y {:.6g} N/m, T {:.6g} N",
                           found.forces.heading, found.forces.normal, found.forces.torque));
}

}  // namespace rondo::study
