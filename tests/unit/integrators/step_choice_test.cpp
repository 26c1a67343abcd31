// SPDX-License-Identifier: BSD-3-Clause
/// What the table of steps says of the fused ones is so: a small model with each feature that they
/// can do is made, is run by them, and moves.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <typeindex>
#include <vector>

#include "integrator_cases.hpp"
#include "rondo/integrators/bodies/bodies_integrator.hpp"
#include "rondo/integrators/fused/cyclic_integrator.hpp"
#include "rondo/integrators/fused/solid/solid_cyclic_integrator.hpp"
#include "rondo/integrators/fused/sparse_integrator.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "support/blocks.hpp"
#include "support/implicit.hpp"
#include "support/rubber.hpp"
#include "support/solid_wheel.hpp"
#include "support/thrown_disk.hpp"

namespace rondo::dynamics::step_choice_test {
namespace {

/// Gives a body one of the features.
struct Maker {
  Features feature;
  std::function<void(test::Built&)> add;
};

void add_implicit(test::Built& b) {
  const std::vector<char> inner = test::cells_of_layers(b.mesh, {1});
  b.model.implicit = test::implicit_part(b.mesh, b.materials, inner);
}

void add_rubber(test::Built& b) {
  b.materials = {test::rubber_material(test::neo_hooke(5e6, 5e7))};
  b.model.stiffness = fem::assemble_stiffness(b.mesh, b.materials);
  test::set_rubber(b);
}

void set_sharp_ground(test::Built& b) {
  test::add_ground(b, {.profile = {{-9, -0.4}, {0, -0.29}, {9, -0.4}}}, {0.4, 0.0});
  b.model.contact->edges = b.mesh.contact_edges;
}

const std::vector<Maker> plane_makers{
    {0, [](test::Built&) {}},
    {has::pressure, test::add_pressures},
    {has::sharp_corners, set_sharp_ground},
    {has::restitution, [](test::Built& b) { b.model.contact->law.restitution = 0.5; }},
    {has::energy_safe,
     [](test::Built& b) { b.model.contact->law.impact = contact::Impact::energy_safe; }},
    {has::stiffness_damping, [](test::Built& b) { b.model.stiffness_damping = 1e-6; }},
    {has::loaded_rim, [](test::Built& b) { test::set_rim(b, {}); }},
    {has::massless, [](test::Built& b) { test::make_contact_massless(b); }},
    {has::implicit, add_implicit},
    {has::rubber, add_rubber},
};

test::Built disk() {
  test::DiskCase c = test::rolling_disk(4, 60);
  c.alpha = c.beta = 0.0;
  c.safety = 0.3;
  test::Built b = test::build(c);
  test::add_ground(b, {}, {0.4, 0.0});
  return b;
}

void expect_run_by(StepKind kind, std::type_index integrator, const Model& model) {
  ASSERT_EQ(step_of(model), kind) << row_of(step_of(model)).name;
  State state = test::start_at_rest(model);
  const auto made = make_integrator(model, state);
  const Integrator& run = *made;
  EXPECT_EQ(std::type_index(typeid(run)), integrator);
  std::array<StepReport, 4> reports;
  made->advance(reports);
  EXPECT_EQ(reports.back().step, 4);
  EXPECT_TRUE(std::isfinite(reports.back().balance.kinetic));
}

}  // namespace

TEST(StepChoice, FusedStepsOfADiskDoWhatTheTableSays) {
  int made = 0;
  for (const StiffnessOperator of : {StiffnessOperator::cyclic, StiffnessOperator::sparse}) {
    const bool cyclic = of == StiffnessOperator::cyclic;
    const StepKind kind = cyclic ? StepKind::cyclic : StepKind::sparse;
    for (const Maker& maker : plane_makers) {
      if (!can(kind, maker.feature)) continue;
      SCOPED_TRACE(testing::Message() << row_of(kind).name << ", feature " << maker.feature);
      test::Built b = disk();
      maker.add(b);
      Model model = b.model;
      model.stiffness_operator = of;
      if (cyclic) model.sector = fem::assemble_sector(b.mesh, b.materials);
      ASSERT_EQ(features_of(model) & maker.feature, maker.feature);
      expect_run_by(kind, cyclic ? typeid(CyclicIntegrator) : typeid(SparseIntegrator), model);
      ++made;
    }
  }
  EXPECT_EQ(made, 19);
}

TEST(StepChoice, TheFusedStepOfBodiesDoesWhatTheTableSays) {
  int made = 0;
  for (const Maker& maker : plane_makers) {
    if (!can(StepKind::bodies, maker.feature | has::free_bodies)) continue;
    SCOPED_TRACE(maker.feature);
    for (const bool touching : {false, true}) {
      test::Built b;
      b.mesh = test::free_disk({.radial = 3, .circumferential = 40, .tread = {}});
      b.materials = {fem::Material{1.0e6, 0.3, 1000.0, fem::Plane::strain}};
      b.model = test::body_model(b.mesh, b.materials[0], 0.0, 0.0, 0.5);
      test::add_ground(b.model, b.mesh, {.profile = {{-9, -0.3}, {9, -0.3}}}, {0.4, 0.0});
      if (touching) test::add_surfaces(b.model, b.mesh, {0.4, 0.0});
      maker.add(b);
      ASSERT_EQ(features_of(b.model) & maker.feature, maker.feature);
      expect_run_by(StepKind::bodies, typeid(BodiesIntegrator), b.model);
      ++made;
    }
  }
  EXPECT_EQ(made, 12);
}

TEST(StepChoice, TheFusedStepOfAWheelDoesWhatTheTableSays) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(2, 2, 36));
  const Model plain = test::cornering_model(mesh, {});
  const auto expect = [](const Model& model, Features feature) {
    ASSERT_TRUE(can(StepKind::solid_cyclic, feature | has::three_dimensions));
    ASSERT_EQ(features_of(model) & feature, feature);
    expect_run_by(StepKind::solid_cyclic, typeid(SolidCyclicIntegrator), model);
  };
  expect(plain, has::stiffness_damping);
  expect(test::cornering_model(mesh, {.slip_angle = 0.05, .camber = 0.02}), has::camber);
  Model model = plain;
  model.rim = RimBody{};
  model.rim->mass = model.rim->inertia = 1.0;
  expect(model, has::loaded_rim);
  model = plain;
  model.contact->law.restitution = 0.5;
  expect(model, has::restitution);
  model.contact->law.impact = contact::Impact::energy_safe;
  expect(model, has::energy_safe);
  model.solid->pressures.push_back({std::vector<Vec3>(model.solid->sector.n_local()), Table(1e4)});
  expect(model, has::pressure);
}

}  // namespace rondo::dynamics::step_choice_test
