// SPDX-License-Identifier: BSD-3-Clause
/// Drives the solver from another program, with public headers alone: a spinning disk without a
/// file, by both operators; a mesh; a case in a loop of its own, as a run into a directory, with
/// a friction law of its own, and refused. Arguments: a mesh, a case, a directory for results.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <rondo/analysis/build/build.hpp>
#include <rondo/analysis/run.hpp>
#include <rondo/case/case.hpp>
#include <rondo/contact/friction.hpp>
#include <rondo/core/error.hpp>
#include <rondo/fem/assembly.hpp>
#include <rondo/fem/sector_stiffness.hpp>
#include <rondo/integrators/integrator.hpp>
#include <rondo/integrators/start.hpp>
#include <rondo/io/run_reader.hpp>
#include <rondo/mesh/disk.hpp>
#include <rondo/mesh/gmsh_reader.hpp>
#include <rondo/model/stability/critical_step.hpp>

using namespace rondo;

/// Displacements after 100 steps; the ledger of the last must close.
std::vector<Vec2> displacements(const dynamics::Model& model) {
  const std::vector<Vec2> zero(model.n_nodes());
  dynamics::State state = dynamics::start(model, zero, zero);
  std::vector<dynamics::StepReport> reports(100);
  make_integrator(model, state)->advance(reports, &state);
  return reports.back().balance.relative < 1e-13 ? to_vector(state.u.plane()) : std::vector<Vec2>{};
}

bool operators_agree() {
  const mesh::Mesh mesh = mesh::make_disk({});
  const fem::Material material{2e7, 0.3, 1100.0, fem::Plane::strain};
  dynamics::Model model;
  model.reference = mesh.coordinates;
  model.mass = fem::lumped_mass(mesh, {&material, 1});
  model.free = fem::free_nodes(mesh);
  model.stiffness = fem::assemble_stiffness(mesh, {&material, 1});
  model.sector = fem::assemble_sector(mesh, {&material, 1});
  model.motion.angular_velocity = dynamics::Table(50.0);
  const auto critical =
      dynamics::critical_step(model.stiffness, model.mass, model.free, {},
                              fem::element_eigenvalue_bound(mesh, {&material, 1}));
  model.dt = 0.8 * critical.step;
  model.stiffness_operator = dynamics::StiffnessOperator::sparse;
  const std::vector<Vec2> sparse = displacements(model);
  model.stiffness_operator = dynamics::StiffnessOperator::cyclic;
  const std::vector<Vec2> cyclic = displacements(model);
  double largest = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < std::min(sparse.size(), cyclic.size()); ++i) {
    largest = std::max(largest, norm(sparse[i]));
    worst = std::max(worst, norm(cyclic[i] - sparse[i]));
  }
  return largest > 0.0 && worst < 1e-10 * largest;  // round-off of 100 steps
}

/// The steps of a case, made here and by a run, lead to the same place.
bool steps_are_those_of_a_run(const study::Case& c, const std::filesystem::path& directory) {
  study::RunOptions options;
  options.directory = directory;
  const study::RunReport done = study::run_case(c, options);
  const study::Setup setup = study::build(c, 1);
  dynamics::State state = dynamics::start(setup.model, setup.displacement, setup.velocity);
  const auto integrator = make_integrator(setup.model, state);
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(setup.n_steps));
  integrator->advance(reports, &state);
  const io::RunReader run(directory);
  std::vector<Vec2> last(setup.model.n_nodes());
  run.read(io::Quantity::displacement, run.n_snapshots() - 1, 0, last);
  return done.status == study::RunStatus::done && done.steps == setup.n_steps &&
         Field(last) == state.u;
}

/// A friction law of this program's own: one that is 0 everywhere moves the body as
/// ground.friction = 0 does, which its own friction does not.
bool a_friction_law_is_obeyed(const std::filesystem::path& file) {
  const auto moved = [&](const char* friction, const contact::Friction* law) {
    study::Setup setup = study::build(study::read_case(file, {"time.end=0.015", friction}), 1);
    if (law != nullptr) setup.model.contact->law.friction = *law;
    dynamics::State state = dynamics::start(setup.model, setup.displacement, setup.velocity);
    std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(setup.n_steps));
    make_integrator(setup.model, state)->advance(reports, &state);
    return to_vector(state.u.plane());
  };
  const contact::Friction none([](const contact::SlidingState&) { return 0.0; });
  const auto own = moved("ground.friction=0.6", &none), same = moved("ground.friction=0", nullptr),
             other = moved("ground.friction=0.6", nullptr);
  double wrong = 0.0, seen = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    wrong = std::max(wrong, norm(own[i] - same[i]));
    seen = std::max(seen, norm(other[i] - same[i]));
  }
  return wrong < 1e-9 * seen;  // two steps that agree to round-off
}

bool is_refused(const std::filesystem::path& file) {
  try {
    static_cast<void>(study::read_case(file, {"material.young=2e7", "ground.friction=-1"}));
  } catch (const InputError& error) {
    return error.faults().size() == 2 && error.faults()[1].key == "ground.friction";
  }
  return false;
}

int main(int, char** arguments) {
  if (mesh::read_gmsh({.file = arguments[1]}).mesh.cells.empty()) return 1;
  if (!operators_agree()) return 2;
  const study::Case c = study::read_case(
      arguments[2], {"time.end=0.002", "output.snapshots=2", "solver.operator=sparse"});
  if (!steps_are_those_of_a_run(c, arguments[3])) return 3;
  if (!a_friction_law_is_obeyed(arguments[2])) return 5;
  return is_refused(arguments[2]) ? 0 : 4;
}
