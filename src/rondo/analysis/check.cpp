// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/check.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "rondo/analysis/build.hpp"
#include "rondo/analysis/crush_build.hpp"
#include "rondo/analysis/estimate.hpp"
#include "rondo/analysis/room.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/output/snapshot_schedule.hpp"

namespace rondo::study {
namespace {

/// @param trial time to spend on it [s]
double seconds_per_step(const Setup& setup, double trial) {
  if (trial <= 0.0) return 0.0;
  using Clock = std::chrono::steady_clock;
  const auto integrator =
      make_integrator(setup.model, start(setup.model, setup.displacement, setup.velocity));
  std::array<dynamics::StepReport, 8> reports;  // only their time is of interest
  const auto begin = Clock::now();
  double seconds = 0.0;
  long long steps = 0;
  while (steps < setup.n_steps && seconds < trial) {
    integrator->advance(reports);
    steps += static_cast<long long>(reports.size());
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return steps > 0 ? seconds / static_cast<double>(steps) : 0.0;
}

CheckReport check_crush(const Case& c) {
  const CrushSetup setup = build_crush(c);
  CheckReport r;
  r.nodes = setup.mesh.n_nodes();
  r.elements = setup.mesh.cells.size();
  r.dofs = setup.n_dofs();
  r.bodies = mesh::find_bodies(setup.mesh).count;
  r.candidates = setup.mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(c.material);
  r.increments = c.analysis.increments + c.analysis.slide_increments;
  r.condensed = setup.within_reach;
  r.snapshots = static_cast<std::size_t>(r.increments);
  r.memory_bytes = estimated_memory(c, size_of(setup.mesh));
  r.disk_bytes = disk_needed(c, setup).all;
  r.warnings = c.warnings;
  r.warnings.insert(r.warnings.end(), setup.warnings.begin(), setup.warnings.end());
  return r;
}

}  // namespace

CheckReport check_case(const Case& c, const CheckOptions& options) {
  if (c.analysis.kind == AnalysisKind::crush) return check_crush(c);
  const Setup setup = build(c, options.threads, options.shared);
  CheckReport r;
  r.nodes = setup.mesh.n_nodes();
  r.elements = setup.mesh.cells.size();
  r.dofs = 2 * setup.model.free.size();
  r.bodies = count_bodies(setup.model);
  r.free_bodies = static_cast<int>(setup.model.free_bodies.size());
  r.candidates = setup.mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(c.material);
  r.largest_frequency = setup.critical.omega;
  r.element_bound = setup.critical.element_bound;
  r.critical_step = setup.critical.step;
  r.step = setup.model.dt;
  r.steps = setup.n_steps;
  r.threads = setup.model.threads;
  const SnapshotSchedule schedule = snapshot_schedule(c.output, setup.model.dt, setup.n_steps);
  r.snapshots = schedule.steps.size();
  r.memory_bytes = estimated_memory(c, size_of(setup.mesh));
  r.disk_bytes = disk_needed(c, setup, schedule).all;
  r.seconds = seconds_per_step(setup, options.trial_s) * static_cast<double>(setup.n_steps);
  r.warnings = c.warnings;
  r.warnings.insert(r.warnings.end(), setup.warnings.begin(), setup.warnings.end());
  return r;
}

}  // namespace rondo::study
