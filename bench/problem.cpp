// SPDX-License-Identifier: BSD-3-Clause
#include "problem.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/model/hyperelastic.hpp"
#include "rondo/model/stability/critical_step.hpp"
#include "support/models.hpp"

namespace rondo::bench {
namespace {

/// The cells of one sector, which represent all.
mesh::Mesh one_sector(const mesh::Mesh& mesh) {
  mesh::Mesh part;
  part.coordinates = mesh.coordinates;
  for (const mesh::Cell& cell : mesh.cells)
    if (mesh.sector[static_cast<std::size_t>(cell[0])] == 0) part.cells.push_back(cell);
  return part;
}

/// Flops per node: K u has 8 per block; the others, counted from the formulas: displacement 4,
/// acceleration 14, velocity 18, ledger 23; with stiffness damping 8 and 4 more (bench/README.md).
double flops_per_node(double blocks, bool beta) {
  return 8.0 * blocks + 59.0 + (beta ? 12.0 : 0.0);
}

}  // namespace

std::string_view name_of(Steps steps) noexcept {
  constexpr std::array<std::string_view, 4> names{"cyclic", "sparse", "eigen", "reference"};
  return names[static_cast<std::size_t>(steps)];
}

Problem::Problem(const mesh::Disk& disk) : mesh_(mesh::make_disk(disk)) {
  const test::DiskCase defaults = test::rolling_disk(1, 3);
  model_.reference = mesh_.coordinates;
  model_.mass = fem::lumped_mass(mesh_, {&defaults.material, 1});
  model_.free = fem::free_nodes(mesh_);
  model_.sector = fem::assemble_sector(mesh_, {&defaults.material, 1});
  model_.mass_damping = defaults.alpha;
  model_.motion = defaults.motion;
  model_.motion.height = dynamics::Table(0.2995);  // contact of 35 mm from the first step on
  omega_ = std::sqrt(fem::element_eigenvalue_bound(one_sector(mesh_), {&defaults.material, 1}));
}

void Problem::stand_at(double height) {
  model_.motion.speed = dynamics::Table(0.0);
  model_.motion.start_x = 0.0;
  model_.motion.height = dynamics::Table(height);
}

void Problem::assemble() {
  if (!stiffness_.row_start.empty() || !model_.stiffness.row_start.empty()) return;
  const fem::Material material = test::DiskCase{}.material;
  stiffness_ = fem::assemble_stiffness(mesh_, {&material, 1});
}

const fem::BlockCsr& Problem::blocks() {
  assemble();
  return model_.stiffness.row_start.empty() ? stiffness_ : model_.stiffness;
}

const CsrMatrix& Problem::csr() {
  if (csr_.rows() == 0) csr_ = csr_matrix(blocks(), model_.free);
  return csr_;
}

namespace {

/// So heavy that the disk stays in place while steps are timed.
dynamics::RimBody loaded_rim() {
  dynamics::RimBody rim;
  rim.free_y = rim.free_spin = true;
  rim.mass = 1e4;
  rim.inertia = 1e2;
  rim.force_y = dynamics::Table(-1.5e5);
  rim.support_y = {.stiffness = 0.0, .damping = 6e5, .at = 0.3};
  return rim;
}

}  // namespace

/// Moves the mass to the nodes below the contact nodes, or back.
void Problem::move_mass(bool from_contact) {
  if (!model_.lumped_mass.empty()) model_.mass = std::exchange(model_.lumped_mass, {});
  if (!from_contact) return;
  model_.lumped_mass = model_.mass;
  model_.mass = fem::move_contact_mass(mesh_, model_.mass, mesh_.boundary).mass;
}

/// Cells of a disk are numbered layer by layer in each column.
void Problem::make_implicit(int layer) {
  model_.implicit.reset();
  if (layer == 0) return;
  const auto sectors = static_cast<std::size_t>(mesh_.n_sectors);
  const std::size_t layers = mesh_.cells.size() / sectors;
  mesh::Mesh part = mesh_;
  part.cells.clear();
  for (std::size_t j = 0; j < sectors; ++j)
    part.cells.push_back(mesh_.cells[j * layers + static_cast<std::size_t>(layer) - 1]);
  const fem::Material material = test::DiskCase{}.material;
  dynamics::ImplicitPart implicit{fem::assemble_stiffness(part, {&material, 1}), {}};
  for (std::size_t k = 0; k < implicit.stiffness.n_rows(); ++k)
    if (implicit.stiffness.row_start[k + 1] > implicit.stiffness.row_start[k])
      implicit.nodes.push_back(static_cast<int>(k));
  model_.implicit = std::move(implicit);
}

/// Makes all cells rubber, or none.
void Problem::make_rubber(const std::optional<fem::Rubber>& rubber) {
  model_.rubber.reset();
  model_.internal_force = nullptr;
  if (!rubber) return;
  fem::Material material;
  material.rubber = rubber;
  model_.internal_force = dynamics::hyperelastic_maker(
      std::make_shared<const fem::Hyperelasticity>(mesh_, std::span(&material, 1)));
  fem::BlockCsr none;
  none.row_start.assign(model_.n_nodes() + 1, 0);
  model_.rubber = dynamics::RubberPart{
      mesh_.cells, std::vector<int>(mesh_.cells.size(), 0), {*rubber}, std::move(none)};
}

std::unique_ptr<dynamics::Integrator> Problem::integrator(Steps steps, const Variant& variant) {
  const test::DiskCase defaults;
  model_.threads = variant.threads;
  model_.stiffness_damping = variant.beta ? defaults.beta : 0.0;
  model_.dt = 0.8 * dynamics::critical_step_of(omega_, {model_.stiffness_damping, 0.0});
  model_.contact.reset();
  if (variant.rolling)
    model_.contact.emplace(dynamics::ContactModel{contact::Ground(variant.ground),
                                                  {0.3, 0.0},
                                                  mesh_.boundary,
                                                  mesh_.tributary,
                                                  mesh_.contact_edges});
  model_.pressures.clear();
  if (variant.pressure != 0.0)
    model_.pressures.push_back({mesh_.contact_edges, dynamics::Table(variant.pressure)});
  model_.rim.reset();
  if (variant.loaded_rim) model_.rim = loaded_rim();
  move_mass(variant.massless);
  make_implicit(variant.implicit_layer);
  make_rubber(variant.rubber);
  // The cyclic operator must not have the assembled matrix, as on meshes that are too large for it.
  const bool assembled = steps != Steps::cyclic || variant.massless;
  if (assembled) assemble();
  if (assembled == model_.stiffness.row_start.empty()) std::swap(stiffness_, model_.stiffness);
  dynamics::State start = test::start_at_rest(model_);
  switch (steps) {
    case Steps::cyclic:
      model_.stiffness_operator = dynamics::StiffnessOperator::cyclic;
      return make_integrator(model_, std::move(start));
    case Steps::sparse:
      model_.stiffness_operator = dynamics::StiffnessOperator::sparse;
      return make_integrator(model_, std::move(start));
    case Steps::eigen:
      return make_csr_steps(model_, csr(), start);
    case Steps::reference:
      return std::make_unique<dynamics::GeneralIntegrator>(model_, start);
  }
  RONDO_DEMAND(false, static_cast<int>(steps));
  return nullptr;
}

Work Problem::work(Steps steps, const Variant& variant) {
  const fem::SectorStiffness& sector = *model_.sector;
  const auto nodes = static_cast<double>(model_.free.size());
  const double blocks =
      static_cast<double>(sector.entries.size()) / static_cast<double>(sector.n_local());
  Work work;
  work.flops = 0.5 * flops_per_node(blocks, variant.beta);
  work.streams.length = n_dofs();
  work.streams.in_place = variant.beta ? 3 : 2;  // u, v, and K u of the previous step
  // Bytes per node that are only read: values and columns of its rows, starts of the rows, mass, X.
  const double of_blocks = 36.0 * blocks + 8.0 + 24.0, of_csr = 48.0 * blocks + 8.0 + 24.0;
  if (steps != Steps::cyclic)
    work.streams.read_only =
        static_cast<std::size_t>(nodes * (steps == Steps::eigen ? of_csr : of_blocks) / 8.0);
  return work;
}

}  // namespace rondo::bench
