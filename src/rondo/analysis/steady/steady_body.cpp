// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_body.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/solid/solid_body.hpp"
#include "rondo/analysis/build/steady_start.hpp"
#include "rondo/analysis/build/tyre/wheel_at_rest.hpp"
#include "rondo/core/index.hpp"
#include "rondo/modal/critical_speeds.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// K := K + K_σ of the stress of the spin.
void add_stress_stiffening(const Case& c, SteadyBody<2>& b) {
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

/// The critical spin is that of a body as stiff as it is against sudden strains. Below it, down to
/// the critical spin of slow strains, the branches damp the waves.
template <int D>
void warn_of_critical_spin(const Case& c, SteadyBody<D>& b) {
  if (spin_of(c) == 0.0) return;
  const fem::SectorBlocks<D> at_once = fem::with_branches<D>(b.sector, b.viscous);
  const auto found =
      modal::critical_speeds_up_to<D>({at_once, b.mass, b.mesh.coordinates}, std::abs(spin_of(c)));
  if (found.empty()) return;
  b.warnings.push_back(
      above_critical_spin(c, *std::ranges::min_element(found, {}, &modal::CriticalSpeed::spin)));
}

/// (n_local) in the frame of the sector: the curves of a disk are the same in all.
std::vector<Vec2> load_of(const Case& c, const SteadyBody<2>& b) {
  dynamics::Model model;
  model.reference = b.mesh.coordinates;
  add_pressures(c, b.mesh, model);
  return sector_load(model, b.sector);
}

std::vector<Vec3> load_of(const Case& c, const SteadyBody<3>& b) {
  return solid_sector_load(c, b.mesh, b.sector, 0.0);
}

/// What is without mass hands it to rows below it.
template <int D>
void demand_rows_below(const Case& c, const SteadyBody<D>& b) {
  if (c.analysis.massless_contact && candidate_rows(b.mesh, b.sector).size() == b.sector.n_local())
    throw case_error(c, c.section ? "section.file" : "disk.mesh.radial",
                     "the nodes below the contact nodes are held by the rim",
                     "at least 2 elements between tread and rim; or analysis.massless_contact = "
                     "false with analysis.samples_per_sector = 1");
}

statics::RollingInertia inertia_of(const Case& c) {
  switch (c.analysis.inertia) {
    case RollingMasses::waves:
      return statics::RollingInertia::waves;
    case RollingMasses::none:
      return statics::RollingInertia::none;
    case RollingMasses::all:
      break;
  }
  return statics::RollingInertia::all;
}

double radius_of(const Case& c, const mesh::Mesh& mesh) {
  if (is_generated(c) && !c.inflation) return c.disk.outer_radius;
  double radius = 0.0;
  for (const int node : mesh.boundary) radius = std::max(radius, norm(mesh.coordinates[at(node)]));
  return radius;
}

/// Numbers that nonlinear forces take besides: factors of all harmonics, of the tangent at each
/// sample and of one more that is being made; fields.
std::size_t nonlinear_numbers(std::size_t nodes, std::size_t candidates, std::size_t samples) {
  constexpr std::size_t fields = 20, of_a_row = 800;
  const std::size_t dofs = 3 * nodes;
  return dofs * (samples * (3 * candidates + fields + of_a_row) + of_a_row);
}

}  // namespace

template <int D>
std::size_t SteadyBody<D>::memory(const Case& c) const {
  const auto samples = static_cast<std::size_t>(c.analysis.samples_per_sector);
  const auto sectors = static_cast<std::size_t>(mesh.n_sectors);
  const std::size_t candidates = mesh.boundary.size() / sectors, turn = samples * sectors;
  // History, its spectra, the last layer; in the plane two kernels.
  constexpr std::size_t copies = D == 2 ? 5 : 3;
  const std::size_t compliance = copies * D * D * candidates * candidates * turn;
  // Fields, rates, spectrum; how a layer follows the next, as far as it is kept.
  constexpr std::size_t most_kept = 250'000'000;
  const std::size_t nodes = mesh.n_nodes(), fields = 4 * D * nodes * samples;
  const std::size_t transfers =
      std::min(most_kept, nodes * samples * D * D * candidates * sizeof(double));
  const std::size_t pairs = turn * candidates / 8;  // half a sector's pass touches at most
  // Matrices and their factors; a step of the slip has two windows more.
  const std::size_t of_pairs = (2 * D * D + D * (D - 1)) * (has_slip_step(c) ? 3 : 1);
  const std::size_t nonlinear = c.inflation && c.inflation->nonlinear != TyreMotion::linear
                                    ? nonlinear_numbers(nodes, candidates, samples)
                                    : 0;
  return mesh_memory(nodes) + transfers +
         (compliance + fields + of_pairs * pairs * pairs + nonlinear) * sizeof(double);
}

template <int D>
void SteadyBody<D>::assemble(const Case& c) {
  if constexpr (D == 2) {
    mass = fem::lumped_mass(mesh, materials);
  } else {
    WheelAtRest rest = wheel_at_rest(c, mesh, materials);
    mass = std::move(rest.mass);
    sector = std::move(rest.sector);
    inflation = std::move(rest.inflation);
    swept = std::move(rest.swept);
    viscous = std::move(rest.viscous);
  }
  dofs = D * fem::free_nodes(mesh).size();
  demand_range(c, *this);
  if constexpr (D == 2) {
    sector = fem::assemble_sector(mesh, materials);
    viscous = fem::viscous_parts<fem::SectorStiffness>(mesh, materials, fem::ViscousBy::material);
  }
  sector_dofs = D * sector.n_local();
  if constexpr (D == 2) add_stress_stiffening(c, *this);
  radius = radius_of(c, mesh);
  static_cast<void>(load_of(c, *this));  // refused before anything takes time
  demand_rows_below(c, *this);
  warn_of_critical_spin(c, *this);
}

template <int D>
void SteadyBody<D>::find_harmonics(const Case& c, int threads) {
  if (harmonics) return;
  const auto begin = Clock::now();
  harmonics.emplace(statics::RollingBody<D>{.stiffness = sector,
                                            .mass = mass,
                                            .reference = mesh.coordinates,
                                            .axial = mesh.axial,
                                            .candidates = candidate_rows(mesh, sector),
                                            .spin = spin_of(c),
                                            .rest_spin = c.inflation ? spin_at_rest(c) : 0.0,
                                            .mass_damping = c.damping.mass,
                                            .stiffness_damping = c.damping.stiffness,
                                            .viscous = viscous,
                                            .samples = c.analysis.samples_per_sector,
                                            .massless = c.analysis.massless_contact,
                                            .inertia = inertia_of(c),
                                            .load = load_of(c, *this),
                                            .threads = threads_for(c, *this, threads)});
  if constexpr (D == 2) window.emplace(window_of(c, slip_of(c)));
  if (swept) harmonics->keep_factors();
  harmonics_wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
}

template <int D>
statics::RollingWindow<D> SteadyBody<D>::window_of(const Case& c,
                                                   statics::SlipDifference slip) const {
  if (window && slip == slip_of(c)) return *window;
  return {*harmonics, slip, c.motion.camber, c.motion.gravity.at(0.0)};
}

template class SteadyBody<2>;
template class SteadyBody<3>;

}  // namespace rondo::study
