// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_body.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/steady_start.hpp"
#include "rondo/modal/critical_speeds.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// K := K + K_σ of the stress of the spin.
void add_stress_stiffening(const Case& c, SteadyBody& b) {
  if (c.stress_stiffening == StressStiffening::none) return;
  const auto found =
      statics::centrifugal_prestress(b.sector, b.mass, b.mesh.coordinates, spin_of(c));
  if (found.status != statics::SpinStatus::solved)
    throw case_error(c, "material.stress_stiffening",
                     "the stress of the spin was not found: the stiffness is not positive definite "
                     "to round-off",
                     "\"none\", or a material and a mesh in SI units");
  b.sector = fem::assemble_sector(b.mesh, b.materials, found.u);
}

void warn_of_critical_spin(const Case& c, SteadyBody& b) {
  const double spin = std::abs(spin_of(c));
  const auto found = modal::critical_speeds_up_to({b.sector, b.mass, b.mesh.coordinates}, spin);
  if (found.empty()) return;
  const auto lowest =
      std::ranges::min_element(found, [](const auto& x, const auto& y) { return x.spin < y.spin; });
  b.warnings.push_back(above_critical_spin(c, *lowest));
}

/// (n_local) in the frame of the sector: the curves of a disk are the same in all.
std::vector<Vec2> load_of(const Case& c, const SteadyBody& b) {
  dynamics::Model model;
  model.reference = b.mesh.coordinates;
  add_pressures(c, b.mesh, model);
  return sector_load(model, b.sector);
}

}  // namespace

std::size_t SteadyBody::memory(const Case& c) const {
  const auto samples = static_cast<std::size_t>(c.analysis.samples_per_sector);
  const auto sectors = static_cast<std::size_t>(mesh.n_sectors);
  const std::size_t candidates = mesh.boundary.size() / sectors;
  const std::size_t turn = samples * sectors;
  constexpr std::size_t copies = 5;  // history, its spectra, the last layer, two kernels
  const std::size_t compliance = copies * 4 * candidates * candidates * turn;
  // Fields, rates, spectrum; how a layer follows the next; half a sector's pass touches at most.
  const std::size_t layer = 2 * candidates;
  const std::size_t fields = (4 + layer) * 2 * mesh.n_nodes() * samples;
  const std::size_t pairs = turn * candidates / 8;
  return mesh_memory(mesh.n_nodes()) + (compliance + fields + 10 * pairs * pairs) * sizeof(double);
}

void SteadyBody::assemble(const Case& c) {
  mass = fem::lumped_mass(mesh, materials);
  dofs = 2 * fem::free_nodes(mesh).size();
  demand_range(c, *this);
  sector = fem::assemble_sector(mesh, materials);
  sector_dofs = 2 * sector.n_local();
  add_stress_stiffening(c, *this);
  static_cast<void>(load_of(c, *this));  // refused before anything takes time
  warn_of_critical_spin(c, *this);
}

void SteadyBody::find_harmonics(const Case& c, int threads) {
  if (harmonics) return;
  const auto begin = Clock::now();
  harmonics.emplace(statics::RollingBody{.stiffness = sector,
                                         .mass = mass,
                                         .reference = mesh.coordinates,
                                         .candidates = candidate_rows(mesh, sector),
                                         .spin = spin_of(c),
                                         .mass_damping = c.damping.mass,
                                         .stiffness_damping = c.damping.stiffness,
                                         .samples = c.analysis.samples_per_sector,
                                         .massless = c.analysis.massless_contact,
                                         .gravity = c.motion.gravity.at(0.0),
                                         .load = load_of(c, *this),
                                         .threads = threads_for(c, *this, threads)});
  window.emplace(*harmonics, slip_of(c));
  harmonics_wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace rondo::study
