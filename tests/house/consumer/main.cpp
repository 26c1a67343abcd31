// SPDX-License-Identifier: BSD-3-Clause
/// Drives the solver from another program: a spinning disk, without a file, by the readable step
/// and by both operators; reads a mesh.
#include <algorithm>
#include <memory>
#include <rondo/case/case.hpp>
#include <rondo/integrators/general/general_integrator.hpp>
#include <rondo/integrators/integrator.hpp>
#include <rondo/integrators/start.hpp>
#include <rondo/mesh/disk.hpp>
#include <rondo/mesh/gmsh_reader.hpp>
#include <rondo/model/stability/critical_step.hpp>

using namespace rondo;

/// Largest difference of the displacements after as many steps as the reference has made, over the
/// largest displacement.
double difference(const dynamics::Model& model, const dynamics::State& reference) {
  const std::vector<Vec2> zero(model.n_nodes());
  dynamics::State state = dynamics::start(model, zero, zero);
  const std::unique_ptr<dynamics::Integrator> integrator = make_integrator(model, state);
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(reference.step));
  integrator->advance(reports, &state);
  double largest = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < state.u.size(); ++i) {
    largest = std::max(largest, norm(reference.u[i]));
    worst = std::max(worst, norm(state.u[i] - reference.u[i]));
  }
  return worst / largest;
}

int main(int, char** arguments) {
  if (mesh::read_gmsh({.file = arguments[1]}).mesh.cells.empty()) return 1;
  const mesh::Mesh mesh = mesh::make_disk({});
  const fem::Material material{2e7, 0.3, 1100.0, fem::Plane::strain};
  dynamics::Model model;
  model.reference = mesh.coordinates;
  model.mass = fem::lumped_mass(mesh, {&material, 1});
  model.free = fem::free_nodes(mesh);
  model.stiffness = fem::assemble_stiffness(mesh, {&material, 1});
  model.motion.angular_velocity = dynamics::Table(50.0);
  const auto critical =
      dynamics::critical_step(model.stiffness, model.mass, model.free, {},
                              fem::element_eigenvalue_bound(mesh, {&material, 1}));
  model.dt = 0.8 * critical.step;
  const std::vector<Vec2> zero(model.n_nodes());
  dynamics::State state = dynamics::start(model, zero, zero);
  dynamics::GeneralIntegrator general(model, state);
  std::vector<dynamics::StepReport> reports(100);
  general.advance(reports, &state);
  bool same = true;
  model.sector = fem::assemble_sector(mesh, {&material, 1});
  for (const auto of : {dynamics::StiffnessOperator::sparse, dynamics::StiffnessOperator::cyclic}) {
    model.stiffness_operator = of;
    same = same && difference(model, state) < 1e-10;  // round-off of 100 steps
  }
  return same && reports.back().balance.relative < 1e-13 && !study::write_case({}).empty() ? 0 : 1;
}
