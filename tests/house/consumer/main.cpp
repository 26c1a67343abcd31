// SPDX-License-Identifier: BSD-3-Clause
/// Drives the solver from another program: a spinning disk, without a file; reads a mesh.
#include <rondo/dynamics/critical_step.hpp>
#include <rondo/dynamics/stepper.hpp>
#include <rondo/mesh/disk.hpp>
#include <rondo/mesh/gmsh_reader.hpp>
#include <rondo/study/case.hpp>

int main(int, char** arguments) {
  using namespace rondo;
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
  dynamics::Ledger ledger;
  for (int n = 0; n < 100; ++n) static_cast<void>(dynamics::advance(model, state, ledger));
  return ledger.last().relative < 1e-13 && !study::write_case({}).empty() ? 0 : 1;
}
