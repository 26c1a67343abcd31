// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/solid_steady_body.hpp"

#include <algorithm>
#include <chrono>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/solid/solid_body.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/modal/solid_critical_spin.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<int> candidates_of(const SolidSteadyBody& b) {
  std::vector<char> touches(b.mesh.n_nodes());
  for (const int node : b.mesh.boundary) touches[static_cast<std::size_t>(node)] = 1;
  std::vector<int> rows;
  for (std::size_t a = 0; a < b.sector.n_local(); ++a)
    if (touches[b.sector.node(a, 0)]) rows.push_back(static_cast<int>(a));
  return rows;
}

/// What is without mass hangs on rows below it.
void demand_rows_below(const Case& c, const SolidSteadyBody& b) {
  if (c.analysis.massless_contact && candidates_of(b).size() == b.sector.n_local())
    throw case_error(c, c.section ? "section.file" : "disk.mesh.radial",
                     "the nodes below the contact nodes are held by the rim",
                     "at least 2 elements between tread and rim; or analysis.massless_contact = "
                     "false with analysis.samples_per_sector = 1");
}

/// (n_local) in the frame of the sector.
std::vector<Vec3> load_of(const Case& c, const SolidSteadyBody& b) {
  if (c.pressures.empty()) return {};
  dynamics::SolidBody body;
  body.sector = b.sector;
  add_solid_pressures(c, b.mesh, body);
  std::vector<Vec3> load(b.sector.n_local());
  for (const dynamics::SolidPressure& p : body.pressures)
    for (std::size_t a = 0; a < load.size(); ++a) load[a] += p.pressure.at(0.0) * p.force[a];
  return load;
}

void warn_of_critical_spin(const Case& c, SolidSteadyBody& b) {
  const auto lowest = modal::lowest_critical_spin(b.sector, b.mass, spin_of(c));
  if (lowest) b.warnings.push_back(above_critical_spin(c, *lowest));
}

double radius_of(const Case& c, const mesh::Mesh& mesh) {
  if (is_generated(c)) return c.disk.outer_radius;
  double radius = 0.0;
  for (const int node : mesh.boundary)
    radius = std::max(radius, norm(mesh.coordinates[static_cast<std::size_t>(node)]));
  return radius;
}

}  // namespace

std::size_t SolidSteadyBody::memory(const Case& c) const {
  const auto samples = static_cast<std::size_t>(c.analysis.samples_per_sector);
  const auto sectors = static_cast<std::size_t>(mesh.n_sectors);
  const std::size_t candidates = mesh.boundary.size() / sectors, turn = samples * sectors;
  constexpr std::size_t copies = 3;  // history, its spectra, the last layer
  const std::size_t compliance = copies * 9 * candidates * candidates * turn;
  // Fields, rates, spectrum; how a layer follows the next, as far as it is kept.
  constexpr std::size_t most_kept = 250'000'000;
  const std::size_t nodes = mesh.n_nodes();
  const std::size_t fields = 12 * nodes * samples;
  const std::size_t transfers =
      std::min(most_kept, nodes * samples * 9 * candidates * sizeof(double));
  const std::size_t pairs = turn * candidates / 8;
  return mesh_memory(nodes) + transfers +
         (compliance + fields + 24 * pairs * pairs) * sizeof(double);
}

void SolidSteadyBody::assemble(const Case& c) {
  mass = fem::solid_mass(mesh, materials);
  demand_range(c, *this);
  dofs = 3 * fem::free_nodes(mesh).size();
  sector = fem::assemble_solid_sector(mesh, materials);
  sector_dofs = 3 * sector.n_local();
  radius = radius_of(c, mesh);
  static_cast<void>(load_of(c, *this));  // refused before anything takes time
  demand_rows_below(c, *this);
  warn_of_critical_spin(c, *this);
}

void SolidSteadyBody::find_harmonics(const Case& c, int threads) {
  if (harmonics) return;
  const auto begin = Clock::now();
  harmonics.emplace(statics::SolidRollingBody{.stiffness = sector,
                                              .mass = mass,
                                              .reference = mesh.coordinates,
                                              .axial = mesh.axial,
                                              .candidates = candidates_of(*this),
                                              .spin = spin_of(c),
                                              .mass_damping = c.damping.mass,
                                              .stiffness_damping = c.damping.stiffness,
                                              .samples = c.analysis.samples_per_sector,
                                              .massless = c.analysis.massless_contact,
                                              .load = load_of(c, *this),
                                              .threads = threads_for(c, *this, threads)});
  harmonics_wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace rondo::study
