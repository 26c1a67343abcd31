// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/steady_start.hpp"
#include "rondo/modal/critical_speeds.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// s, counter-clockwise.
double spin_of(const Case& c) {
  return -c.motion.angular_velocity.at(0.0);
}

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
  b.warnings.push_back(fmt::format(
      "motion.angular_velocity: {:.6g} rad/s is above the critical spin of this mesh, {:.6g} rad/s "
      "({} nodal diameters), at which a wave stands still in the fixed frame: damping alone bounds "
      "the deformation",
      spin, lowest->spin, lowest->diameters));
}

/// (n_local) in the frame of the sector: the curves of a disk are the same in all.
std::vector<Vec2> load_of(const Case& c, const SteadyBody& b) {
  dynamics::Model model;
  model.reference = b.mesh.coordinates;
  add_pressures(c, b.mesh, model);
  return sector_load(model, b.sector);
}

/// Equal for cases that share harmonics.
std::string harmonics_key(const Case& c) {
  const AnalysisCase& a = c.analysis;
  return fmt::format("{}\n{:a} {:a} {:a} {:a} {} {} {}", body_key(c), spin_of(c), c.damping.mass,
                     c.damping.stiffness, c.motion.gravity.at(0.0), a.samples_per_sector,
                     static_cast<int>(a.slip), a.massless_contact);
}

struct KeptSteady {
  std::string key;
  std::shared_ptr<SteadyBody> body;
};

}  // namespace

std::size_t steady_memory(const Case& c, const SteadyBody& b) {
  const auto samples = static_cast<std::size_t>(c.analysis.samples_per_sector);
  const auto sectors = static_cast<std::size_t>(b.mesh.n_sectors);
  const std::size_t candidates = b.mesh.boundary.size() / sectors;
  const std::size_t turn = samples * sectors;
  constexpr std::size_t copies = 5;  // history, its spectra, the last layer, two kernels
  const std::size_t compliance = copies * 4 * candidates * candidates * turn;
  // Fields, rates, spectrum; how a layer follows the next; half a sector's pass touches at most.
  const std::size_t layer = 2 * candidates;
  const std::size_t fields = (4 + layer) * 2 * b.mesh.n_nodes() * samples;
  const std::size_t pairs = turn * candidates / 8;
  return mesh_memory(b.mesh.n_nodes()) +
         (compliance + fields + 10 * pairs * pairs) * sizeof(double);
}

std::shared_ptr<SteadyBody> make_steady_body(const Case& c) {
  auto body = std::make_shared<SteadyBody>();
  SteadyBody& b = *body;
  b.mesh = build_mesh(c, &b.warnings);
  b.materials = materials_of(c, b.mesh);
  warn_of_units(c, b.mesh, b.materials, b.warnings);
  demand_memory(c, b.mesh.n_nodes(), steady_memory(c, b));
  b.mass = fem::lumped_mass(b.mesh, b.materials);
  b.free = fem::free_nodes(b.mesh);
  b.sector = fem::assemble_sector(b.mesh, b.materials);
  add_stress_stiffening(c, b);
  static_cast<void>(load_of(c, b));  // refused before anything takes time
  warn_of_critical_spin(c, b);
  return body;
}

void find_harmonics(const Case& c, SteadyBody& b, int threads) {
  if (b.harmonics) return;
  const auto samples = static_cast<std::size_t>(c.analysis.samples_per_sector);
  if (threads == 0)
    threads = samples * b.free.size() < single_thread_dofs
                  ? 1
                  : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const auto begin = Clock::now();
  b.harmonics.emplace(statics::RollingBody{.stiffness = b.sector,
                                           .mass = b.mass,
                                           .reference = b.mesh.coordinates,
                                           .candidates = candidate_rows(b.mesh, b.sector),
                                           .spin = spin_of(c),
                                           .mass_damping = c.damping.mass,
                                           .stiffness_damping = c.damping.stiffness,
                                           .samples = c.analysis.samples_per_sector,
                                           .massless = c.analysis.massless_contact,
                                           .gravity = c.motion.gravity.at(0.0),
                                           .load = load_of(c, b),
                                           .threads = threads});
  b.window.emplace(*b.harmonics, c.analysis.slip == RollingSlip::bdf2
                                     ? statics::SlipDifference::bdf2
                                     : statics::SlipDifference::upwind);
  b.harmonics_wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
}

std::shared_ptr<SteadyBody> shared_steady_body(const Case& c, SharedBody* shared) {
  if (!shared) return make_steady_body(c);
  std::string key = harmonics_key(c);
  if (const auto* kept = std::any_cast<KeptSteady>(&shared->other); kept && kept->key == key)
    return kept->body;
  std::shared_ptr<SteadyBody> body = make_steady_body(c);
  shared->other = KeptSteady{std::move(key), body};
  return body;
}

}  // namespace rondo::study
