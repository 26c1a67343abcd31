// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/solid_steady_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/solid/solid_body.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// s, counter-clockwise.
double spin_of(const Case& c) {
  return -c.motion.angular_velocity.at(0.0);
}

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

double radius_of(const Case& c, const mesh::Mesh& mesh) {
  if (is_generated(c)) return c.disk.outer_radius;
  double radius = 0.0;
  for (const int node : mesh.boundary)
    radius = std::max(radius, norm(mesh.coordinates[static_cast<std::size_t>(node)]));
  return radius;
}

/// Equal for cases that share harmonics.
std::string harmonics_key(const Case& c) {
  const AnalysisCase& a = c.analysis;
  return fmt::format("{}\n{:a} {:a} {:a} {} {}", body_key(c), spin_of(c), c.damping.mass,
                     c.damping.stiffness, a.samples_per_sector, a.massless_contact);
}

struct KeptSolidSteady {
  std::string key;
  std::shared_ptr<SolidSteadyBody> body;
};

std::shared_ptr<SolidSteadyBody> make_solid_steady_body(const Case& c) {
  auto body = std::make_shared<SolidSteadyBody>();
  SolidSteadyBody& b = *body;
  b.mesh = build_mesh(c, &b.warnings);
  b.materials = materials_of(c, b.mesh);
  warn_of_units(c, b.mesh, b.materials, b.warnings);
  demand_memory(c, b.mesh.n_nodes(), steady_memory(c, b.mesh));
  b.mass = fem::solid_mass(b.mesh, b.materials);
  b.dofs = 3 * fem::free_nodes(b.mesh).size();
  b.sector = fem::assemble_solid_sector(b.mesh, b.materials);
  b.radius = radius_of(c, b.mesh);
  static_cast<void>(load_of(c, b));  // refused before anything takes time
  demand_rows_below(c, b);
  return body;
}

}  // namespace

std::size_t steady_memory(const Case& c, const mesh::Mesh& mesh) {
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

void find_harmonics(const Case& c, SolidSteadyBody& b, int threads) {
  if (b.harmonics) return;
  const auto samples = static_cast<std::size_t>(c.analysis.samples_per_sector);
  if (threads == 0)
    threads = samples * b.dofs < 2 * single_thread_dofs
                  ? 1
                  : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const auto begin = Clock::now();
  b.harmonics.emplace(statics::SolidRollingBody{.stiffness = b.sector,
                                                .mass = b.mass,
                                                .reference = b.mesh.coordinates,
                                                .axial = b.mesh.axial,
                                                .candidates = candidates_of(b),
                                                .spin = spin_of(c),
                                                .mass_damping = c.damping.mass,
                                                .stiffness_damping = c.damping.stiffness,
                                                .samples = c.analysis.samples_per_sector,
                                                .massless = c.analysis.massless_contact,
                                                .load = load_of(c, b),
                                                .threads = threads});
  b.harmonics_wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
}

std::shared_ptr<SolidSteadyBody> shared_solid_steady_body(const Case& c, SharedBody* shared) {
  if (!shared) return make_solid_steady_body(c);
  std::string key = harmonics_key(c);
  const auto* kept = std::any_cast<KeptSolidSteady>(&shared->other);
  if (kept && kept->key == key) return kept->body;
  std::shared_ptr<SolidSteadyBody> body = make_solid_steady_body(c);
  shared->other = KeptSolidSteady{std::move(key), body};
  return body;
}

}  // namespace rondo::study
