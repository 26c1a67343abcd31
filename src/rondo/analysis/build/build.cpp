// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/analysis/build/ground/contact_law.hpp"
#include "rondo/analysis/build/ground/ground_lines.hpp"
#include "rondo/analysis/build/ground/held_ground.hpp"
#include "rondo/analysis/build/ground/road_lines.hpp"
#include "rondo/analysis/build/ground/small_ground.hpp"
#include "rondo/analysis/build/ground/wheel_obstacles.hpp"
#include "rondo/analysis/build/ground/wheel_road.hpp"
#include "rondo/analysis/build/initial_state.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/rim.hpp"
#include "rondo/analysis/build/rubber.hpp"
#include "rondo/analysis/build/solid/solid_body.hpp"
#include "rondo/analysis/build/stability.hpp"
#include "rondo/analysis/elements/combinations.hpp"
#include "rondo/analysis/elements/implicit.hpp"
#include "rondo/analysis/elements/massless_boundary.hpp"
#include "rondo/analysis/elements/subdomains.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/case/features/case_features.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/limits/processors.hpp"
#include "rondo/integrators/fused/batch_integrator.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/model/friction_work.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::study {

namespace {

/// Adds what the candidates may touch: the ground, and bodies.
void add_contacts(const Case& c, const mesh::Mesh& mesh, dynamics::Model& model) {
  RONDO_DEMAND(mesh.tributary.size() == mesh.boundary.size() && model.n_nodes() == mesh.n_nodes(),
               mesh.tributary.size(), mesh.boundary.size(), model.n_nodes(), mesh.n_nodes());
  if (c.ground)
    model.contact.emplace(dynamics::ContactModel{
        contact::Ground(c.ground->shape, mesh::longest_edge(mesh.coordinates, mesh.contact_edges)),
        law_of(*c.ground), mesh.boundary, mesh.tributary, mesh.contact_edges});
  const BodyContactCase& between = c.body_contact;
  if (between.between != BodyContact::none)
    model.surfaces.emplace(
        dynamics::SurfaceContact{mesh.boundary, mesh.tributary, mesh.contact_edges,
                                 between.between == BodyContact::all, law_of(between)});
}

/// Refuses a curve whose nodes are all held: it feels no pressure.
void refuse_held_curve(const Case& c, const mesh::Mesh& mesh, const std::string& key,
                       const std::string& name, const std::vector<mesh::Edge>& edges) {
  const std::vector<char> held = mesh::clamped_flags(mesh);
  const auto is_held = [&](int node) { return held[at(node)] != 0; };
  if (!std::ranges::all_of(edges,
                           [&](const mesh::Edge& e) { return is_held(e[0]) && is_held(e[1]); }))
    return;
  throw case_error(
      c, key,
      fmt::format("every node of the curve \"{}\" is held: a pressure there has no effect", name),
      c.mesh ? fmt::format("a curve that is not held; mesh.clamped = \"{}\" holds this one",
                           fmt::join(c.mesh->clamped, "\", \""))
             : "\"tread\", the outer boundary; the inner boundary of a [disk] is its rim: for a "
               "cavity that is inflated, a [mesh] whose mesh.clamped is another curve");
}

/// Bodies that nothing holds, where they start. They turn, and so do the sectors of a free disk,
/// which are none then.
void find_bodies(const Case& c, Setup& s) {
  if (!may_be_free(c)) return;
  dynamics::find_free_bodies(s.mesh, s.model);
  place_free_bodies(c, s.mesh, s.model);
  if (s.model.free_bodies.empty()) return;
  s.mesh.n_sectors = 0;
  s.mesh.sector.clear();
  s.mesh.sector_node.clear();
}

/// Sector by sector wherever the fused step can.
dynamics::StiffnessOperator operator_of(const Case& c, const dynamics::Model& model) {
  const auto cyclic = dynamics::StepKind::cyclic;
  const auto of_model = features_of(model) & ~dynamics::Features{dynamics::has::assembled};
  const bool fused = model.sector && can(cyclic, study::features_of(c) | of_model);
  return fused ? dynamics::StiffnessOperator::cyclic : dynamics::StiffnessOperator::sparse;
}

void make_model(const Case& c, Setup& s) {
  dynamics::Model& model = s.model;
  model.scheme = c.time.scheme;
  model.reference = s.mesh.coordinates;
  model.mass = fem::lumped_mass(s.mesh, s.materials);
  model.free = fem::free_nodes(s.mesh);
  RONDO_DEMAND(model.mass.size() == model.n_nodes(), model.mass.size(), model.n_nodes());
  find_bodies(c, s);
  add_contacts(c, s.mesh, model);
  add_pressures(c, s.mesh, model);
  refuse_combinations(c, model);
  add_rim(c, s.mesh, model);
  make_contact_massless(c, s);
  if (s.mesh.n_sectors > 0) model.sector = fem::assemble_sector(s.mesh, s.materials);
  model.stiffness_operator = operator_of(c, model);
  if (model.stiffness_operator == dynamics::StiffnessOperator::sparse || !by_harmonics(model))
    model.stiffness = fem::assemble_stiffness(s.mesh, s.materials);
  model.stiffness_damping = c.damping.stiffness;
  add_rubber(c, s);
  if (!fem::has_rubber(s.materials))
    model.viscous =
        fem::viscous_parts<fem::BlockCsr>(s.mesh, s.materials, fem::ViscousBy::branches);
}

/// Sets what does not change the body: see body_key().
void set_motion_and_friction(const Case& c, dynamics::Model& model) {
  model.mass_damping = c.damping.mass;
  model.motion = c.motion;
  RONDO_DEMAND(c.ground.has_value() == model.contact.has_value(), c.ground.has_value());
  set_rim_loads(c, model);
  model.coupled = {c.contact_iterations, c.dump_contacts};
  if (model.contact) model.contact->law = law_of(*c.ground);
}

/// K := K + K_σ of the stress of the initial spin, in both forms as far as they are there.
void add_stress_stiffening(const Case& c, Setup& s) {
  if (c.stress_stiffening == StressStiffening::none) return;
  dynamics::Model& m = s.model;
  const double spin = c.motion.angular_velocity.at(0.0);
  if (spin == 0.0)
    s.warnings.emplace_back(
        "material.stress_stiffening has no effect: the initial angular velocity is 0");
  RONDO_DEMAND(by_harmonics(m) || m.stiffness.row_start.size() == m.n_nodes() + 1,
               m.stiffness.row_start.size(), m.n_nodes());
  auto found =
      by_harmonics(m)
          ? statics::centrifugal_prestress(*m.sector, m.mass, m.reference, spin)
          : statics::centrifugal_prestress(m.stiffness, m.mass, m.reference, held_nodes(m), spin);
  if (found.status != statics::SpinStatus::solved)
    throw case_error(c, "material.stress_stiffening",
                     "the stress of the spin was not found: the stiffness is not positive definite "
                     "to round-off",
                     "\"none\", or a material and a mesh in SI units");
  s.prestress = to_vector(found.u.plane());
  RONDO_DEMAND(s.prestress.size() == m.n_nodes(), s.prestress.size(), m.n_nodes());
  if (m.sector) m.sector = fem::assemble_sector(s.mesh, s.materials, s.prestress);
  if (!m.stiffness.row_start.empty())
    m.stiffness = fem::assemble_stiffness(s.mesh, s.materials, s.prestress);
}

}  // namespace

void choose_threads(Setup& s, int asked) {
  const int most = dynamics::most_threads(s.model);
  if (asked > most)
    s.warnings.push_back(
        fmt::format("{} threads instead of {}: the {} operator shares out no smaller parts of this "
                    "body (docs/performance.md)",
                    most, asked, operator_name(s.model.stiffness_operator)));
  if (asked <= 0) {
    const bool small = count_dofs(s.model) < single_thread_dofs;
    asked = small ? 1 : allowed_processors();
  }
  s.model.threads = std::min(asked, most);
  RONDO_DEMAND(s.model.threads >= 1, asked, most);
}

namespace {

/// Chooses the step of what is explicit.
double choose_step(const Case& c, const dynamics::CriticalStep& critical) {
  if (std::isinf(critical.step)) {  // nothing is explicit
    if (c.time.step) return *c.time.step;
    throw case_error(
        c, "time.step",
        "all elements are implicit: every step is stable, so that the program chooses none",
        "time.step, a tenth of the shortest period that counts or less");
  }
  if (!(critical.omega > 0.0) || !std::isfinite(critical.omega) || !(critical.step > 0.0))
    throw case_error(c, "material.youngs_modulus",
                     fmt::format("with this density and mesh the largest frequency is {} rad/s, "
                                 "out of the range of floating-point numbers",
                                 critical.omega),
                     "a modulus and a density in SI units");
  if (!c.time.step) return c.time.safety * critical.step;
  if (*c.time.step > critical.step * (1.0 + 1e-12))
    throw case_error(
        c, "time.step",
        fmt::format(
            "the step {:.6g} s is above the critical step {:.6g} s of this mesh and material{}",
            *c.time.step, critical.step, c.hati ? ", of its fine part" : ""),
        fmt::format("0 < step <= {:.6g}, or leave it out and give time.safety", critical.step));
  return *c.time.step;
}

/// With the rim held; of one of its own proven where it can be, also on a small disk.
dynamics::CriticalStep body_step(const Setup& s, dynamics::LaggedDamping damping) {
  const dynamics::Model& m = s.model;
  if (by_harmonics(m) || (m.rim && m.sector))
    return dynamics::critical_step(*m.sector, m.mass, damping,
                                   fem::sector_eigenvalue_bound(s.mesh, s.materials, s.prestress));
  RONDO_DEMAND(m.stiffness.row_start.size() == m.n_nodes() + 1 && m.threads >= 1,
               m.stiffness.row_start.size(), m.n_nodes(), m.threads);
  const double bound = fem::element_eigenvalue_bound(s.mesh, s.materials, s.prestress);
  return dynamics::critical_step(m.stiffness, m.mass, nodes_with_mass(m), damping,
                                 bound / least_mass_share(m), m.threads);
}

/// The critical step as if contact nodes had their mass.
double plain_step(const Setup& s, dynamics::LaggedDamping damping) {
  const dynamics::Model& m = s.model;
  RONDO_DEMAND(m.lumped_mass.size() == m.n_nodes(), m.lumped_mass.size(), m.n_nodes());
  return dynamics::critical_step(m.stiffness, m.lumped_mass, m.free, damping,
                                 fem::element_eigenvalue_bound(s.mesh, s.materials, s.prestress),
                                 m.threads)
      .step;
}

/// The critical step of what is explicit.
dynamics::CriticalStep find_critical_step(const Case& c, Setup& s) {
  const bool lagged = c.time.scheme == Scheme::as_printed || c.rim;
  const dynamics::LaggedDamping damping{c.damping.stiffness, lagged ? c.damping.mass : 0.0};
  const dynamics::CriticalStep held = body_step(s, damping);
  s.critical_plain = has_massless_contact(s.model) ? plain_step(s, damping) : held.step;
  if (s.model.implicit) return explicit_part_step(s, damping);
  if (s.model.subdomains) return fine_part_step(s, damping);
  return s.model.rim ? step_with_rim(s.model, held, damping) : held;
}

/// The critical step of the body as stiff as it is at once: with its viscous branches.
dynamics::CriticalStep find_step_at_once(const Case& c, Setup& s) {
  if (!fem::has_branches(s.materials)) return find_critical_step(c, s);
  std::vector<fem::Material> materials = fem::instantaneous(s.materials);
  fem::BlockCsr stiffness = fem::assemble_stiffness(s.mesh, materials, s.prestress);
  std::optional<fem::SectorStiffness> sector;
  if (s.model.sector) sector = fem::assemble_sector(s.mesh, materials, s.prestress);
  const auto exchange = [&] {
    std::swap(s.materials, materials);
    std::swap(s.model.stiffness, stiffness);
    std::swap(s.model.sector, sector);
  };
  exchange();
  const dynamics::CriticalStep found = find_critical_step(c, s);
  exchange();
  return found;
}

}  // namespace

void add_pressures(const Case& c, const mesh::Mesh& mesh, dynamics::Model& model) {
  for (std::size_t k = 0; k < c.pressures.size(); ++k) {
    const auto& [name, pressure] = c.pressures[k];
    const std::string key = item_of("load.pressure", k) + ".curve";
    const std::vector<mesh::Edge>& edges = curve_of(c, mesh, key, name);
    refuse_held_curve(c, mesh, key, name, edges);
    model.pressures.push_back({edges, pressure});
  }
}

long long count_steps(const Case& c, double dt) {
  const double steps = c.time.end / dt;
  if (steps > 1e12)
    throw case_error(c, "time.end", fmt::format("the run would take {:.3g} steps", steps),
                     "at most 1e+12 steps");
  RONDO_DEMAND(dt > 0.0 && std::isfinite(dt), dt);
  const double nearest = std::round(steps);  // 0.1 / 1e-5 is 10000, whatever its last bit says
  const double whole = std::abs(steps - nearest) < 1e-9 * nearest ? nearest : std::ceil(steps);
  return std::max(1LL, static_cast<long long>(whole));  // the quotient of a tiny end may be 0
}

std::size_t count_dofs(const dynamics::Model& model) {
  return (model.solid ? 3 : 2) * model.free.size();
}

int count_bodies(const dynamics::Model& model) {
  return model.body.empty() ? 1 : 1 + *std::max_element(model.body.begin(), model.body.end());
}

bool by_harmonics(const dynamics::Model& model) {
  return model.sector && 2 * model.free.size() > harmonic_setup_dofs &&
         !has_massless_contact(model);  // whose ring is assembled
}

std::vector<int> held_nodes(const dynamics::Model& model) {
  RONDO_DEMAND(model.free_body.empty() || model.free_body.size() == model.n_nodes(),
               model.free_body.size(), model.n_nodes());
  std::vector<int> held = model.free;
  std::erase_if(held,
                [&](int node) { return in_fixed_frame(model, static_cast<std::size_t>(node)); });
  return held;
}

std::string body_key(const Case& c) {
  Case body = c;
  for (const CaseKey& key : case_keys())
    if (!key.use.changes_body(c)) reset(key, body);
  if (c.stress_stiffening != StressStiffening::none ||
      (c.inflation && !c.inflation->spin))  // by the spin at the start
    body.motion.angular_velocity = dynamics::Table(c.motion.angular_velocity.at(0.0));
  return write_case(body);
}

namespace {

/// The part of the setup that takes time. It depends on body_key() alone.
void make_body(const Case& c, int threads, Setup& s) {
  s.mesh = build_mesh(c, &s.warnings);
  s.materials = materials_of(c, s.mesh);
  warn_of_units(c, s.mesh, s.materials, s.warnings);
  demand_memory(c, s.mesh.n_nodes(), motion_memory(c, s.mesh));
  check_places(c, s.mesh);
  if (s.mesh.is_solid()) return make_solid_body(c, threads, s);
  s.probes = find_probes(c, s.mesh);  // before free bodies are moved to where they start
  make_model(c, s);
  s.dilatation = fem::NodalDilatation(s.mesh, s.materials);
  add_stress_stiffening(c, s);
  demand_held_ring(c, s.model);
  add_implicit(c, s);
  add_subdomains(c, s);
  choose_threads(s, threads);
  s.critical = find_step_at_once(c, s);
}

void demand_shared_body(const Case& c, int threads, SharedBody& shared) {
  std::string key = fmt::format("{}\nthreads = {}\n", body_key(c), threads);
  if (shared.key != key) {
    shared = {};
    make_body(c, threads, shared.setup);
    shared.key = std::move(key);
  }
  check_places(c, shared.setup.mesh);
}

/// The part of the setup that depends on the rest of the case.
void set_up_run(const Case& c, Setup& s, SharedBody* shared, Steps steps) {
  RONDO_DEMAND(s.model.n_nodes() > 0 && s.model.n_nodes() == s.mesh.n_nodes() &&
                   s.probes.size() == (s.model.solid ? 0 : c.output.probes.size()),
               s.model.n_nodes(), s.mesh.n_nodes(), s.probes.size());  // make_body() has been
  set_motion_and_friction(c, s.model);
  set_wheel_road(c, s);
  set_wheel_obstacles(c, s);
  if (c.output.friction_work)
    s.model.friction_work = std::make_shared<dynamics::FrictionWork>(s.model);
  const int ratio = s.model.subdomains ? s.model.subdomains->ratio : 1;
  s.model.dt = ratio * choose_step(c, s.critical);
  s.n_steps = count_steps(c, s.model.dt);
  RONDO_ASSERT(std::ranges::all_of(s.model.free,
                                   [&](int node) {
                                     const auto k = static_cast<std::size_t>(node);
                                     return lumped_mass_of(s.model)[k] > 0.0;
                                   }),
               s.model.free.size());  // else choose_step() had refused the numbers
  if (steps == Steps::of_full_run) check_branches(c, s);
  set_initial_fields(c, s, shared);
  refuse_held_in_ground(c, s);
  for (std::string told : {held_outside_contact(c, s), small_ground(c, s)})
    if (!told.empty()) s.warnings.push_back(std::move(told));
  check_start(c, s);
  check_stability(c, s);
  tell_physical_figures(c, s);
  tell_road(c, s);
  tell_ground(c, steps, s);
  if (s.model.solid) tell_solid_figures(c, s);
}

/// Units that look wrong are told with what is refused: they may be its cause.
InputError with_units(const Case& c, const Setup& s, const InputError& refusal) {
  std::vector<std::string> units;
  if (!s.materials.empty()) warn_of_units(c, s.mesh, s.materials, units);
  std::vector<Fault> faults = refusal.faults();
  for (const std::string& text : units)
    faults.push_back({c.file.string(), 0, 0, "", "", "this may be the cause: " + text, ""});
  return InputError(std::move(faults));
}

}  // namespace

Setup build(const Case& c, int threads, SharedBody* shared, Steps steps) {
  Setup s;
  try {
    if (shared) {
      demand_shared_body(c, threads, *shared);
      s = shared->setup;
    } else {
      make_body(c, threads, s);
    }
    set_up_run(c, s, shared, steps);
    if (shared) shared->setup.frequencies_above = s.frequencies_above;
    return s;
  } catch (const InputError& refusal) {
    throw with_units(c, shared && s.materials.empty() ? shared->setup : s, refusal);
  }
}

}  // namespace rondo::study
