// SPDX-License-Identifier: BSD-3-Clause
/// The step allocates nothing.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "integrator_cases.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/model/friction_work.hpp"
#include "support/allocations.hpp"
#include "support/implicit.hpp"
#include "support/rubber.hpp"
#include "support/solid_wheel.hpp"
#include "support/stepping.hpp"

namespace allocation_test {

using namespace rondo;
using test::allocations;

namespace {

class Allocations : public testing::TestWithParam<std::tuple<dynamics::StiffnessOperator, int>> {};

}  // namespace

TEST(Allocation, NoneInTheReferenceStep) {
  const auto b = test::build(test::everything("", 6, 90));
  dynamics::GeneralIntegrator integrator(b.model, test::start_at_rest(b.model));
  std::vector<dynamics::StepReport> reports(1000);
  integrator.advance(reports);  // as little as contacts need more memory than any before
  long in_contact = 0;
  const long before = allocations();
  integrator.advance(std::span(reports).first(100));
  EXPECT_EQ(allocations() - before, 0);
  for (int n = 0; n < 100; ++n) in_contact += reports[static_cast<std::size_t>(n)].contact.nodes;
  EXPECT_GT(in_contact, 0);
  const long counted = allocations();
  const std::vector<Vec2> something(10);
  EXPECT_EQ(allocations() - counted, 1);  // the counter counts
}

/// From the very first call, with and without the last state.
TEST_P(Allocations, NoneInTheStepsOfAnIntegrator) {
  const auto [of, threads] = GetParam();
  dynamics::Model model = test::model_with(test::build(test::everything("", 6, 90)), of);
  model.threads = threads;
  model.friction_work = std::make_shared<dynamics::FrictionWork>(model);
  dynamics::State state = test::start_at_rest(model);
  const auto integrator = dynamics::make_integrator(model, state);
  std::vector<dynamics::StepReport> reports(64);
  long in_contact = 0;
  const long before = allocations();
  for (int call = 0; call < 4; ++call) {
    integrator->advance(reports, call % 2 == 0 ? nullptr : &state);
    for (const dynamics::StepReport& report : reports) in_contact += report.contact.nodes;
  }
  integrator->fields(state);
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_GT(in_contact, 0);
}

/// Inside the body from the first step on; at the ground once as many contacts hang together as
/// ever, and each node that touches has its column.
TEST_P(Allocations, NoneInTheStepsOfImplicitElements) {
  const auto [of, threads] = GetParam();
  for (const bool at_the_ground : {false, true}) {
    test::Built b = test::build(test::everything("", 6, 90));
    const auto cells = test::cells_of_layers(b.mesh, {at_the_ground ? 6 : 3});
    b.model.implicit = test::implicit_part(b.mesh, b.materials, cells);
    b.model.motion = test::rolling_disk(6, 90).motion;
    b.model.motion.angular_velocity = b.model.motion.speed = dynamics::Table(0.0);
    b.model.motion.start_x = 0.3;
    b.model.motion.height = dynamics::Table({{0.0, 0.3}, {0.01, 0.292}});
    dynamics::Model model = test::model_with(b, of);
    model.threads = threads;
    dynamics::State state = test::start_at_rest(model);
    const auto integrator = dynamics::make_integrator(model, state);
    std::vector<dynamics::StepReport> reports(64);
    for (int call = 0; at_the_ground && call < 20; ++call) integrator->advance(reports);
    const long before = allocations();
    long in_contact = 0;
    for (int call = 0; call < 4; ++call) {
      integrator->advance(reports, call % 2 == 0 ? nullptr : &state);
      for (const dynamics::StepReport& report : reports) in_contact += report.contact.nodes;
    }
    EXPECT_EQ(allocations() - before, 0) << at_the_ground;
    EXPECT_GT(in_contact, 0);
  }
}

TEST(Allocation, NoneInTheFusedStepsOfRubber) {
  test::DiskCase c = test::rolling_disk(4, 60);
  fem::Rubber rubber = test::neo_hooke(2.0e6, 8.0e7);
  rubber.branches = {{0.3, 1.0e-3}};
  c.material = test::rubber_material(rubber);
  c.safety = 0.6;
  for (const int threads : {1, 2}) {
    test::Built b = test::build(c);
    test::add_ground(b, {.profile = {{-1, 0}, {1, 0}}}, {0.3, 0.0});
    b.model.pressures.push_back({b.mesh.contact_edges, dynamics::Table(1.0e4)});
    test::set_rubber(b);
    b.model.threads = threads;
    dynamics::State state = test::start_at_rest(b.model);
    const auto integrator = dynamics::make_integrator(b.model, state);
    std::vector<dynamics::StepReport> reports(64);
    integrator->advance(reports);
    const long before = allocations();
    integrator->advance(reports, &state);
    EXPECT_EQ(allocations() - before, 0);
    EXPECT_GT(reports.back().contact.nodes, 0);
  }
}

TEST(Allocation, NoneInTheStepsOfAWheelInThreeDimensions) {
  const mesh::Mesh mesh = mesh::make_wheel(test::box_wheel(3, 4, 100));
  for (const int threads : {1, 2}) {
    test::Cornering cornering;
    cornering.slip_angle = 0.05;
    dynamics::Model model = test::cornering_model(mesh, cornering);
    model.friction_work = std::make_shared<dynamics::FrictionWork>(model);
    model.threads = threads;
    const Field zero(model.n_nodes(), 3);
    dynamics::State state = dynamics::start(model, zero, zero);
    const auto integrator = dynamics::make_integrator(model, state);
    std::vector<dynamics::StepReport> reports(64);
    long in_contact = 0;
    const long before = allocations();
    for (int call = 0; call < 4; ++call) {
      integrator->advance(reports, call % 2 == 0 ? nullptr : &state);
      for (const dynamics::StepReport& report : reports) in_contact += report.contact.nodes;
    }
    integrator->fields(state);
    EXPECT_EQ(allocations() - before, 0) << threads;
    EXPECT_GT(in_contact, 0);
  }
}

/// It could not report that there is no memory.
TEST(Allocation, AStateWithoutRoomForAllContactsIsNotTaken) {
  for (const dynamics::StiffnessOperator of : test::both_operators) {
    const dynamics::Model model = test::model_with(test::build(test::everything("", 3, 45)), of);
    const dynamics::State start = test::start_at_rest(model);
    const auto integrator = dynamics::make_integrator(model, start);
    std::vector<dynamics::StepReport> reports(1);
    dynamics::State copy = start;
    EXPECT_DEATH(integrator->advance(reports, &copy), "active.capacity.*values: 0 90");
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Allocations,
                         testing::Combine(testing::ValuesIn(test::both_operators),
                                          testing::Values(1, 2)),
                         [](const auto& p) {
                           return test::name(std::get<0>(p.param)) + "_" +
                                  std::to_string(std::get<1>(p.param));
                         });

}  // namespace allocation_test
