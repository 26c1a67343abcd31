// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/steady_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/plausible/number_range.hpp"
#include "rondo/analysis/build/tyre/inflation_members.hpp"
#include "rondo/analysis/steady/steady_body.hpp"
#include "rondo/core/limits/processors.hpp"

namespace rondo::study {
namespace {

std::shared_ptr<RolledBody> make_body(const Case& c) {
  std::shared_ptr<RolledBody> body;
  if (is_solid(c))
    body = std::make_shared<SteadyBody<3>>();
  else
    body = std::make_shared<SteadyBody<2>>();
  RolledBody& b = *body;
  b.mesh = build_mesh(c, &b.warnings);
  b.materials = materials_of(c, b.mesh);
  warn_of_units(c, b.mesh, b.materials, b.warnings);
  demand_memory(c, b.mesh.n_nodes(), b.memory(c));
  b.assemble(c);
  return body;
}

struct KeptBody {
  std::string key;
  std::shared_ptr<RolledBody> body;
};

}  // namespace

std::string harmonics_key(const Case& c) {
  const AnalysisCase& a = c.analysis;
  std::string key = fmt::format("{}\n{:a} {:a} {:a} {} {} {}", body_key(c), spin_of(c),
                                c.damping.mass, c.damping.stiffness, a.samples_per_sector,
                                a.massless_contact, static_cast<int>(a.inertia));
  // In three dimensions both come with the state.
  if (!is_solid(c))
    key += fmt::format(" {:a} {}", c.motion.gravity.at(0.0), static_cast<int>(a.slip));
  return key;
}

double spin_of(const Case& c) {
  return -c.motion.angular_velocity.at(0.0);
}

statics::SlipDifference slip_of(const Case& c) {
  return c.analysis.slip == RollingSlip::bdf2 ? statics::SlipDifference::bdf2
                                              : statics::SlipDifference::upwind;
}

double floor_of(const Case& c) {
  return c.ground->shape.profile.front().y;
}

void demand_range(const Case& c, const RolledBody& body) {
  const double highest = 0.5 * body.mesh.n_sectors * c.analysis.samples_per_sector;
  demand_harmonic_range(c, body.materials, body.mass, highest * std::abs(spin_of(c)));
}

void demand_free_shape(const Case& c, double lowest, double radius) {
  constexpr double most = 2.0;
  if (lowest < most * radius) return;
  throw case_error(
      c, furthest_key(c),
      fmt::format("spin, weight and loads alone, without contact, move the lowest point of the "
                  "body from {1:.3g} m to {0:.3g} m away from the axle",
                  lowest, radius),
      fmt::format("less of them, or a stiffer material: at most {:.3g} m", most * radius));
}

std::string above_critical_spin(const Case& c, const modal::CriticalSpeed& lowest) {
  return fmt::format(
      "motion.angular_velocity: {:.6g} rad/s is above the critical spin of this mesh, {:.5g} rad/s "
      "({} nodal diameters), at which a wave stands still in the fixed frame: only damping limits "
      "the deformation",
      std::abs(spin_of(c)), lowest.spin, lowest.diameters);
}

int threads_for(const Case& c, const RolledBody& body, int asked) {
  if (asked != 0) return asked;
  const auto samples = static_cast<std::size_t>(c.analysis.samples_per_sector);
  if (samples * body.dofs < 2 * single_thread_dofs) return 1;
  return allowed_processors();
}

void add_body(const Case& c, const RolledBody& body, CheckReport& r) {
  r.nodes = body.mesh.n_nodes();
  r.elements = body.mesh.n_elements();
  r.dofs = body.dofs;
  r.candidates = body.mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(c.material);
  r.memory_bytes = body.memory(c);
  if (!body.inflation) return;
  for (Told& line : told_of(*body.inflation)) r.lines.push_back(std::move(line));
}

void describe_body(const Case& c, const RolledBody& body, Json& j) {
  add_size(body.mesh.n_nodes(), body.dofs, j);
  if (is_solid(c)) add_wheel({}, body.mesh.n_sectors, c.motion.camber, j);
  if (body.inflation) add_inflation(*body.inflation, j);
}

std::string no_solution(const Case& c) {
  return fmt::format(
      "the harmonics of a sector have no solution in the range of floating-point numbers; other "
      "values, first of {}: are they in SI units?",
      furthest_key(c));
}

std::vector<std::string> all_warnings(const Case& c, const RolledBody& body,
                                      const std::vector<std::string>& more) {
  std::vector<std::string> all = c.warnings;
  all.insert(all.end(), body.warnings.begin(), body.warnings.end());
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::shared_ptr<RolledBody> rolled_body(const Case& c, SharedBody* shared) {
  if (!shared) return make_body(c);
  std::string key = harmonics_key(c);
  if (const auto* kept = std::any_cast<KeptBody>(&shared->other); kept && kept->key == key)
    return kept->body;
  std::shared_ptr<RolledBody> body = make_body(c);
  shared->other = KeptBody{std::move(key), body};
  return body;
}

}  // namespace rondo::study
