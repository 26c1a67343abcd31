// SPDX-License-Identifier: BSD-3-Clause
/// Cost of a step of a wheel in three dimensions in ns per degree of freedom and step, for the
/// whole step with spin, both dampings and ledger: `bench_solid [ROUNDS [THREADS [LARGEST]]]`,
/// LARGEST 1 to 3 of the sizes below. The same step by assembled rows of 3×3 blocks is shown for
/// comparison. Wheels spin freely, or roll with a slip angle, driven or on a rim with a load. The
/// smallest time of a batch of steps counts, because the machine may do other work.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "solid_blocks.hpp"

using namespace rondo;

namespace {

struct Size {
  const char* name;
  int radial, axial, around;                             ///< of the smooth wheel
  int tread_radial, tread_layers, tread_axial, pitches;  ///< of the treaded one
};
constexpr Size sizes[] = {{"3e4", 6, 8, 184, 3, 2, 8, 56},
                          {"3e5", 12, 16, 490, 6, 3, 16, 164},
                          {"3e6", 24, 32, 1260, 10, 4, 20, 850}};

mesh::Wheel wheel_of(const Size& s, bool tread) {
  mesh::Wheel w;
  w.disk.inner_radius = 0.15;
  w.disk.outer_radius = 0.30;
  w.width = 0.1;
  w.disk.radial = tread ? s.tread_radial : s.radial;
  w.axial = tread ? s.tread_axial : s.axial;
  w.disk.circumferential = s.around;
  if (tread) w.disk.tread = mesh::Tread{s.pitches, 0.02, 3, 1, s.tread_layers};
  return w;
}

fem::Material rubber() {
  fem::Material m;
  m.youngs_modulus = 2e7;
  m.poissons_ratio = 0.3;
  m.density = 1100.0;
  return m;
}

enum class Motion { spinning, rolling, loaded };

/// The rim has the height of the driven wheel; its load and a spring hold it there.
dynamics::RimBody loaded_rim(double height) {
  dynamics::RimBody rim;
  rim.free_y = rim.free_spin = true;
  rim.mass = 10.0;
  rim.inertia = 0.3;
  rim.force_y = dynamics::Table(-3000.0);
  rim.support_y = {1e6, 4000.0, height};
  return rim;
}

dynamics::Model model_of(const mesh::Wheel& wheel, Motion motion, int threads) {
  const mesh::Mesh mesh = mesh::make_wheel(wheel);
  const std::vector<fem::Material> materials{rubber()};
  dynamics::Model m;
  m.reference = mesh.coordinates;
  m.mass = fem::solid_mass(mesh, materials);
  m.free = fem::free_nodes(mesh);
  m.solid.emplace(dynamics::SolidBody{mesh.axial, fem::assemble_solid_sector(mesh, materials), {}});
  m.stiffness_operator = dynamics::StiffnessOperator::cyclic;
  m.threads = threads;
  m.mass_damping = 200.0;
  m.dt = 0.8 * 2.0 / std::sqrt(fem::solid_eigenvalue_bound(mesh, materials));
  m.stiffness_damping = 0.02 * m.dt;
  m.motion.angular_velocity = dynamics::Table(33.7);
  m.motion.speed = dynamics::Table(10.0);
  const double height = motion == Motion::spinning ? 1.0 : 0.298;
  m.motion.height = dynamics::Table(height);
  if (motion == Motion::loaded) m.rim = loaded_rim(height);
  m.motion.slip_angle = dynamics::Table(0.03);
  m.contact.emplace(dynamics::ContactModel{
      contact::Ground({}), {.friction = 0.3}, mesh.boundary, mesh.tributary});
  return m;
}

double n_dofs(const dynamics::Model& m) {
  return 3.0 * static_cast<double>(m.free.size());
}

/// CPU time if there is only one thread, which depends less on other work of the machine [s].
double now(int threads) {
  timespec t{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Steps>
double least_time(int rounds, int threads, Steps&& steps) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < rounds; ++i) {
    const double begin = now(threads);
    steps();
    best = std::min(best, now(threads) - begin);
  }
  return best;
}

/// Memory in use by this process [B].
double resident() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, used = 0.0;
  file >> pages >> used;
  return used * 4096.0;
}

struct Measured {
  double ns = 0.0;     ///< per degree of freedom and step
  double bytes = 0.0;  ///< per degree of freedom, of the integrator
  double kinetic = 0.0;
};

Measured measure(const dynamics::Model& m, int rounds, int batch) {
  const dynamics::State start = dynamics::start(m, Field(m.n_nodes(), 3), Field(m.n_nodes(), 3));
  const double before = resident();
  const auto integrator = dynamics::make_integrator(m, start);
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(batch));
  const double time = least_time(rounds, m.threads, [&] { integrator->advance(reports, nullptr); });
  const dynamics::Balance& balance = reports.back().balance;
  if (!(balance.relative < 1e-12)) {
    fmt::print(stderr, "the ledger does not close: {:.2g}\n", balance.relative);
    std::exit(1);
  }
  return {1e9 * time / (n_dofs(m) * batch), (resident() - before) / n_dofs(m), balance.kinetic};
}

Measured measure_blocks(const dynamics::Model& m, int rounds, int batch) {
  const double before = resident();
  bench::SolidBlocks blocks(m);
  const double time = least_time(rounds, m.threads, [&] { blocks.advance(batch); });
  return {1e9 * time / (n_dofs(m) * batch), (resident() - before) / n_dofs(m), blocks.kinetic()};
}

void print(const char* name, const std::string& what, const dynamics::Model& m, const Measured& x) {
  fmt::print("{:4} {:29} {:8.0f} dofs {:8.2f} ns {:7.0f} B a dof\n", name, what, n_dofs(m), x.ns,
             x.bytes);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
  const int threads = argc > 2 ? std::max(1, std::atoi(argv[2])) : 1;
  const int largest = argc > 3 ? std::clamp(std::atoi(argv[3]), 1, 3) : 2;
  for (int i = 0; i < largest; ++i) {
    const Size& s = sizes[i];
    const int batch = i == 0 ? 32 : 8;
    for (const bool tread : {false, true})
      for (const Motion motion : {Motion::spinning, Motion::rolling, Motion::loaded}) {
        const dynamics::Model m = model_of(wheel_of(s, tread), motion, threads);
        const Measured fast = measure(m, rounds, batch);
        constexpr const char* names[] = {"", ", rolling", ", rolling, loaded rim"};
        print(s.name,
              fmt::format("{}{}", tread ? "treaded" : "smooth", names[static_cast<int>(motion)]), m,
              fast);
        if (motion != Motion::spinning || tread || threads > 1) continue;
        const Measured rows = measure_blocks(m, std::max(1, rounds / 10), batch / 4);
        print(s.name, "rows of 3×3 blocks", m, rows);
      }
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("peak of the process: {:.2f} GB\n", static_cast<double>(usage.ru_maxrss) / 1e6);
}
