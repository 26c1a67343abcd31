// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "rondo/dynamics/batch_integrator.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "rondo/study/estimate.hpp"

namespace rondo::study {

InputError case_error(const Case& c, const std::string& key, const std::string& message,
                      const std::string& allowed) {
  Fault fault;
  fault.file = c.file.string();
  fault.key = key;
  fault.message = message;
  fault.allowed = allowed;
  const auto place = c.places.find(key);
  if (place != c.places.end()) {
    fault.file = place->second.file;
    fault.line = place->second.line;
    fault.column = place->second.column;
    fault.found = place->second.written;
  }
  return InputError(fault);
}

namespace {

/// Shortest edge of the cells around each node [m].
std::vector<double> element_sizes(const mesh::Mesh& mesh) {
  std::vector<double> size(mesh.n_nodes(), std::numeric_limits<double>::infinity());
  for (const mesh::Cell& cell : mesh.cells) {
    const int n = mesh::n_corners(cell);
    double shortest = std::numeric_limits<double>::infinity();
    const auto at = [&](int a) {
      return mesh.coordinates[static_cast<std::size_t>(cell[static_cast<std::size_t>(a % n)])];
    };
    for (int a = 0; a < n; ++a) shortest = std::min(shortest, norm(at(a + 1) - at(a)));
    for (int a = 0; a < n; ++a) {
      double& s = size[static_cast<std::size_t>(cell[static_cast<std::size_t>(a)])];
      s = std::min(s, shortest);
    }
  }
  return size;
}

/// Layers that coincide in round-off, by grading or by radii that are nearly the same.
void refuse_flat_elements(const Case& c, const std::vector<double>& size) {
  const double shortest = *std::min_element(size.begin(), size.end());
  if (shortest > 1e-9 * c.disk.outer_radius) return;
  throw case_error(c, c.disk.grading > 1.0 ? "disk.mesh.grading" : "disk.inner_radius",
                   fmt::format("the shortest edge of the mesh would be {:.3g} m", shortest),
                   "a milder grading, fewer layers or columns, a thicker disk");
}

/// What can be done harmonic by harmonic is.
bool by_harmonics(const dynamics::Model& model) {
  return model.sector && 2 * model.free.size() > harmonic_setup_dofs;
}

dynamics::Model make_model(const Case& c, const mesh::Mesh& mesh) {
  dynamics::Model model;
  model.reference = mesh.coordinates;
  model.mass = fem::lumped_mass(mesh, {&c.material, 1});
  model.free = fem::free_nodes(mesh);
  if (mesh.n_sectors > 0) model.sector = fem::assemble_sector(mesh, {&c.material, 1});
  if (model.sector && c.solver_operator != "sparse")
    model.stiffness_operator = dynamics::StiffnessOperator::cyclic;
  if (model.stiffness_operator == dynamics::StiffnessOperator::sparse || !by_harmonics(model))
    model.stiffness = fem::assemble_stiffness(mesh, {&c.material, 1});
  model.mass_damping = c.damping.mass;
  model.stiffness_damping = c.damping.stiffness;
  model.motion = c.motion;
  model.scheme = c.time.scheme;
  if (c.ground)
    model.contact.emplace(dynamics::ContactModel{contact::Ground(c.ground->shape),
                                                 {c.ground->friction, c.ground->restitution},
                                                 mesh.boundary,
                                                 mesh.tributary,
                                                 mesh.contact_edges});
  return model;
}

/// K := K + K_σ of the stress of the initial spin, in both forms as far as they are there.
void add_stress_stiffening(const Case& c, Setup& s) {
  if (c.stress_stiffening == StressStiffening::none) return;
  dynamics::Model& m = s.model;
  const double spin = c.motion.angular_velocity.at(0.0);
  if (spin == 0.0)
    s.warnings.emplace_back(
        "material.stress_stiffening: the initial angular velocity is 0, its stress stiffens "
        "nothing");
  auto found = by_harmonics(m)
                   ? statics::centrifugal_prestress(*m.sector, m.mass, m.reference, spin)
                   : statics::centrifugal_prestress(m.stiffness, m.mass, m.reference, m.free, spin);
  if (found.status != statics::SpinStatus::solved)
    throw case_error(c, "material.stress_stiffening",
                     "the stress of the spin was not found: the stiffness is not positive definite "
                     "to round-off",
                     "\"none\", or a material and a mesh in SI units");
  s.prestress = std::move(found.u);
  if (m.sector) m.sector = fem::assemble_sector(s.mesh, {&c.material, 1}, s.prestress);
  if (!m.stiffness.row_start.empty())
    m.stiffness = fem::assemble_stiffness(s.mesh, {&c.material, 1}, s.prestress);
}

void choose_threads(Setup& s, int asked) {
  const int most = dynamics::most_threads(s.model);
  if (asked > most)
    s.warnings.push_back(
        fmt::format("{} threads instead of {}: the {} operator shares out no smaller parts of this "
                    "body (docs/performance.md)",
                    most, asked, operator_name(s.model.stiffness_operator)));
  if (asked <= 0) {
    const bool small = 2 * s.model.free.size() < single_thread_dofs;
    asked = small ? 1 : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  }
  s.model.threads = std::min(asked, most);
}

double choose_step(const Case& c, const dynamics::CriticalStep& critical) {
  if (!(critical.omega > 0.0) || !std::isfinite(critical.omega) || !(critical.step > 0.0))
    throw case_error(c, "material.youngs_modulus",
                     fmt::format("with this density and mesh the largest frequency is {} rad/s, "
                                 "out of the range of the numbers",
                                 critical.omega),
                     "a modulus and a density in SI units");
  if (!c.time.step) return c.time.safety * critical.step;
  if (*c.time.step > critical.step * (1.0 + 1e-12))
    throw case_error(
        c, "time.step",
        fmt::format(
            "the step {:.6g} s is above the critical step {:.6g} s of this mesh and material",
            *c.time.step, critical.step),
        fmt::format("0 < step <= {:.6g}, or leave it out and give time.safety", critical.step));
  return *c.time.step;
}

long long count_steps(const Case& c, double dt) {
  const double steps = c.time.end / dt;
  if (steps > 1e12)
    throw case_error(c, "time.end", fmt::format("the run would take {:.3g} steps", steps),
                     "at most 1e+12 steps");
  const double nearest = std::round(steps);  // 0.1 / 1e-5 is 10000, whatever its last bit says
  return static_cast<long long>(std::abs(steps - nearest) < 1e-9 * nearest ? nearest
                                                                           : std::ceil(steps));
}

dynamics::CriticalStep find_critical_step(const Case& c, const Setup& s) {
  const dynamics::Model& m = s.model;
  const bool lagged = c.time.scheme == Scheme::as_printed;
  const dynamics::LaggedDamping damping{c.damping.stiffness, lagged ? c.damping.mass : 0.0};
  if (by_harmonics(m))
    return dynamics::critical_step(
        *m.sector, m.mass, damping,
        fem::sector_eigenvalue_bound(s.mesh, {&c.material, 1}, s.prestress));
  return dynamics::critical_step(
      m.stiffness, m.mass, m.free, damping,
      fem::element_eigenvalue_bound(s.mesh, {&c.material, 1}, s.prestress), m.threads);
}

statics::StationarySpin find_stationary_spin(const dynamics::Model& m, double spin) {
  if (by_harmonics(m)) return statics::stationary_spin(*m.sector, m.mass, m.reference, spin);
  return statics::stationary_spin(m.stiffness, m.mass, m.reference, m.free, spin);
}

void set_initial_fields(const Case& c, Setup& s) {
  const dynamics::Model& model = s.model;
  s.displacement.assign(model.n_nodes(), Vec2{});
  s.velocity.assign(model.n_nodes(), Vec2{});
  if (c.initial.state == InitialState::stationary) {
    const double spin = -c.motion.angular_velocity.at(0.0);
    auto stationary = find_stationary_spin(model, spin);
    if (stationary.status != statics::SpinStatus::solved)
      throw case_error(c, "motion.angular_velocity",
                       "no stationary state: at this spin the centrifugal softening "
                       "exceeds the stiffness",
                       "a lower spin, or a stiffer material");
    s.displacement = std::move(stationary.u);
  }
  const auto& g = c.initial.displacement_gradient;
  for (const int node : model.free) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 x = model.reference[k];
    s.displacement[k] += Vec2{g[0][0] * x.x + g[0][1] * x.y, g[1][0] * x.x + g[1][1] * x.y};
    s.velocity[k] = c.initial.velocity;  // θ(0) = 0: both frames have the same axes
  }
}

/// A node deeper than half an element would get an impulse that means nothing: refused. One less
/// deep is held where it is, for the law acts on velocities: said.
void check_start_inside(const Case& c, const std::vector<double>& size, Setup& s) {
  if (!s.model.contact) return;
  const Vec2 center = s.model.motion.center(0.0);
  double deepest = 0.0, worst = 0.0, allowed = 0.0;
  for (const int node : s.model.contact->nodes) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 x = center + s.model.reference[k] + s.displacement[k];
    const double depth = -s.model.contact->ground.distance(x);
    deepest = std::max(deepest, depth);
    if (depth / size[k] <= worst) continue;
    worst = depth / size[k];
    allowed = 0.5 * size[k];
  }
  if (worst > 0.5)
    throw case_error(
        c, "motion.height",
        fmt::format("the body starts {:.4g} m deep inside the ground, more than half an element "
                    "({:.4g} m)",
                    deepest, allowed),
        "start above the ground (motion.height, motion.start_x) and come down by a table");
  if (deepest > 1e-9 * c.disk.outer_radius)
    s.warnings.push_back(
        fmt::format("the body starts {:.4g} m inside the ground: contact keeps it "
                    "from going deeper, but does not push it out",
                    deepest));
}

/// Nothing where factorisations would take too long.
std::optional<bool> softens_little(const dynamics::Model& m, double spin) {
  const double shift = 4.0 * spin * spin;
  const bool harmonics = by_harmonics(m);
  if (!softening_is_checked(2 * m.free.size(), harmonics ? 2 * m.sector->n_local() : 0))
    return std::nullopt;
  if (harmonics) return statics::eigenvalues_above(*m.sector, m.mass, shift);
  return statics::eigenvalues_above(m.stiffness, m.mass, m.free, shift);
}

void warn_of_softening(const Case& c, Setup& s) {
  const double spin = c.motion.angular_velocity.largest();
  if (spin == 0.0 || c.stress_stiffening != StressStiffening::none) return;
  const std::optional<bool> little = softens_little(s.model, spin);
  if (!little)
    s.warnings.push_back(
        fmt::format("the check of spin softening is left out above {} degrees of freedom, unless "
                    "one of equal sectors of the disk has at most {}",
                    softening_check_dofs, softening_check_harmonic_dofs));
  else if (!*little)
    s.warnings.push_back(fmt::format(
        "at {:.6g} rad/s the centrifugal softening takes more than a quarter of the lowest "
        "stiffness (s² > ω₁²/4): a small-strain model without stress stiffening is soft there",
        spin));
}

}  // namespace

mesh::Mesh build_mesh(const Case& c) {
  mesh::Mesh mesh = mesh::make_disk(c.disk);
  refuse_flat_elements(c, element_sizes(mesh));
  return mesh;
}

Setup build(const Case& c, int threads) {
  Setup s;
  s.mesh = build_mesh(c);
  s.model = make_model(c, s.mesh);
  add_stress_stiffening(c, s);
  choose_threads(s, threads);
  set_initial_fields(c, s);
  check_start_inside(c, element_sizes(s.mesh), s);
  s.critical = find_critical_step(c, s);
  s.model.dt = choose_step(c, s.critical);
  s.n_steps = count_steps(c, s.model.dt);
  warn_of_softening(c, s);
  return s;
}

}  // namespace rondo::study
