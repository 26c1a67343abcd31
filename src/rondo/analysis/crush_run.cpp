// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "rondo/analysis/build.hpp"
#include "rondo/analysis/crush_build.hpp"
#include "rondo/analysis/crush_observers.hpp"
#include "rondo/analysis/out_of_range.hpp"
#include "rondo/analysis/room.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Loop {
  RunStatus status = RunStatus::done;
  std::string message;
  int increments = 0;        ///< done, whose results are kept
  double residual = 0.0;     ///< largest of the law
  double equilibrium = 0.0;  ///< largest of K u = Hᵀ r
  double penetration = 0.0;  ///< largest [m]
  int sweeps = 0;            ///< most of an increment
  int pivoted = 0;           ///< increments that the sweeps alone did not solve
  double wall_s = 0.0;
  std::size_t snapshots = 0;
  statics::CrushState state;

  void add(const statics::CrushReport& r) {
    residual = keep_larger(residual, r.residual);
    equilibrium = keep_larger(equilibrium, r.equilibrium);
    penetration = std::max(penetration, r.penetration);
    sweeps = std::max(sweeps, r.sweeps);
    pivoted += r.pivoting != statics::Pivoting::none ? 1 : 0;
  }
};

std::string not_solved(const statics::CrushReport& report, double bound) {
  const char* failed =
      report.pivoting == statics::Pivoting::failed ? ", which found none in numbers" : "";
  return fmt::format(
      "the contact was not solved: contact residual {:.3g}, bound {:.0e}, after {} sweeps and {} "
      "pivots{}; a smaller ground.friction is easier",
      report.residual, bound, report.sweeps, report.pivots, failed);
}

double depth_of(const Analysis& a, int k) {
  return a.depth * std::min(k, a.increments) / a.increments;
}

double slide_of(const Analysis& a, int k) {
  return k <= a.increments ? 0.0 : a.slide * (k - a.increments) / a.slide_increments;
}

/// What increment k brings the centre to.
std::string target(const Analysis& a, int k) {
  const std::string depth = fmt::format("depth {:.6g} m", depth_of(a, k));
  return k <= a.increments ? depth : fmt::format("{}, slide {:.6g} m", depth, slide_of(a, k));
}

statics::CrushReport solve_increment(const Analysis& a, int k, const CrushSetup& setup,
                                     statics::Condensation& body, statics::CrushState& state) {
  return k <= a.increments ? statics::press(setup.model, depth_of(a, k), body, state)
                           : statics::draw(setup.model, slide_of(a, k), body, state);
}

Loop run_loop(const Case& c, const CrushSetup& setup, statics::Condensation& body,
              const RunOptions& options, CrushRecord& record) {
  Loop loop;
  loop.state = statics::start_crush(setup.model, setup.mesh.n_nodes());
  const auto wall = Clock::now();
  const int n = c.analysis.increments + c.analysis.slide_increments;
  while (loop.increments < n && loop.status == RunStatus::done) {
    const int k = loop.increments + 1;
    const std::vector<Vec2> before = loop.state.u;
    const statics::CrushReport report = solve_increment(c.analysis, k, setup, body, loop.state);
    loop.add(report);
    std::string trouble = crush_trouble(report, loop.state.works, setup.model.bound);
    if (trouble.empty()) trouble = beyond_files(setup, loop.state);
    if (!trouble.empty()) {
      loop.status = RunStatus::failed;
      loop.message =
          fmt::format("increment {} of {}, {}: {}", k, n, target(c.analysis, k), trouble);
      break;
    }
    record.observe(k, loop.state, before, report);
    loop.increments = k;
    if (options.stop && options.stop->load(std::memory_order_relaxed) && k < n)
      loop.status = RunStatus::interrupted;
    if (options.progress) options.progress(k, n);
  }
  loop.wall_s = seconds_since(wall);
  return loop;
}

/// Factorised, and nothing condensed: that of the run before where it fits.
std::shared_ptr<statics::Condensation> factorised(const Case& c, const CrushSetup& setup,
                                                  SharedBody* shared) {
  const std::string key = shared ? body_key(c) : std::string();
  if (shared && shared->condensation && shared->crush_key == key) {
    shared->condensation->clear();
    return shared->condensation;
  }
  auto body = std::make_shared<statics::Condensation>(
      fem::assemble_stiffness(setup.mesh, setup.materials), setup.free, setup.model.nodes);
  if (shared) {
    shared->crush_key = key;
    shared->condensation = body;
  }
  return body;
}

Json describe(const Case& c, const CrushSetup& setup, double factor_s) {
  Json j = describe_run(c, "crush", setup.mesh.n_nodes(), setup.n_dofs());
  j["depth"] = c.analysis.depth;
  j["increments"] = c.analysis.increments;
  j["slide"] = c.analysis.slide;
  j["slide_increments"] = c.analysis.slide_increments;
  j["factor_wall_s"] = factor_s;
  return j;
}

void add_outcome(Json& j, const Loop& loop, const statics::Condensation& body) {
  add_status(j, loop.status, loop.message);
  j["increments_done"] = loop.increments;
  j["candidates_condensed"] = body.set().size();
  j["contact_residual_max"] = loop.residual;
  j["equilibrium_residual_max"] = loop.equilibrium;
  j["energy_residual_relative"] = loop.state.works.relative;
  j["energy_exchanged"] = loop.state.works.exchanged;
  j["penetration_max_m"] = loop.penetration;
  j["sweeps_max"] = loop.sweeps;
  j["pivoted_increments"] = loop.pivoted;
  j["loop_wall_s"] = loop.wall_s;
  j["peak_memory_bytes"] = peak_memory_bytes();
  j["snapshots"] = loop.snapshots;
}

RunReport report_of(const Loop& loop) {
  RunReport r;
  r.analysis = AnalysisKind::crush;
  r.status = loop.status;
  r.message = loop.message;
  r.steps = loop.increments;
  r.depth = loop.state.depth;
  r.slide = loop.state.slide;
  r.loop_wall_s = loop.wall_s;
  r.energy_residual_relative = loop.state.works.relative;
  r.contact_residual_max = loop.residual;
  r.penetration_max_m = loop.penetration;
  r.snapshots = loop.snapshots;
  return r;
}

Loop record(const Case& c, const CrushSetup& setup, statics::Condensation& body,
            const RunOptions& options, const Json& json) {
  try {
    CrushRecord files(options.directory, c, setup);
    Loop loop = run_loop(c, setup, body, options, files);
    files.close();
    loop.snapshots = files.written();
    return loop;
  } catch (const std::exception& error) {  // of files, or out of memory
    note_failure(options, json, error);
    throw;
  }
}

}  // namespace

void condense(const Case& c, const CrushSetup& setup, statics::Condensation& body) {
  if (body.factorised()) statics::append_within(setup.model, setup.reach, body);
  if (!body.factorised() || !body.compliance().allFinite())
    throw case_error(c, "material.youngs_modulus",
                     "with this mesh the stiffness is not positive definite in numbers",
                     "a modulus in SI units, a Poisson's ratio farther from 0.5 and -1");
}

std::string crush_trouble(const statics::CrushReport& report, const statics::CrushWorks& works,
                          double bound) {
  if (!std::isfinite(report.residual) || !std::isfinite(report.equilibrium))
    return "the forces or displacements are out of the range of the numbers";
  if (!report.converged) return not_solved(report, bound);
  if (!(report.equilibrium <= residual_bound))
    return fmt::format("residual of the equilibrium {:.3g}, bound {:.0e}", report.equilibrium,
                       residual_bound);
  if (!(works.relative <= residual_bound))
    return fmt::format("the energy does not balance: relative residual {:.3g}, bound {:.0e}",
                       works.relative, residual_bound);
  return {};
}

RunReport run_crush(const Case& c, const RunOptions& options) {
  if (options.resume)
    throw case_error(c, "analysis.kind", "a crush has no checkpoints to go on from",
                     "\"dynamic\", or --overwrite instead of --resume");
  const CrushSetup setup = build_crush(c);
  demand_disk(options, disk_needed(c, setup));  // before minutes of condensing
  const auto begin = Clock::now();
  const std::shared_ptr<statics::Condensation> kept = factorised(c, setup, options.shared);
  statics::Condensation& body = *kept;
  condense(c, setup, body);
  Json json = describe(c, setup, seconds_since(begin));
  give_warnings(c.warnings, options);
  give_warnings(setup.warnings, options);
  const io::DirectoryLock lock = take_directory(c, options);
  begin_files(c, options, json);
  const Loop loop = record(c, setup, body, options, json);
  add_outcome(json, loop, body);
  io::write_json(options.directory / "run.json", json);
  return report_of(loop);
}

}  // namespace rondo::study
