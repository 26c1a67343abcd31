// SPDX-License-Identifier: BSD-3-Clause
/// What is particular to some nodes in the fused steps, loads and sharp corners of the ground: as
/// the general step has it.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "integrator_cases.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "support/stepping.hpp"

namespace held_exceptions_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// Held at its speed, as corners are met at a place.
test::RollingCase on_loaded_rim(const test::RollingCase& c) {
  return test::on_rim(c, false, true, true);
}

/// Pressures; a sharp ledge that the disk is pressed against, and sharp ridges behind it; both; the
/// same rounded by arcs smaller than the elements.
std::vector<test::RollingCase> cases() {
  const mesh::Tread tread{20, 0.02, 3, 1, 2};
  std::vector<test::RollingCase> all;
  for (const auto& with : {test::pressed, test::sharp, test::small_arcs}) {
    all.push_back(with(test::everything("smooth", 6, 90)));
    all.push_back(with(test::everything("treaded", 3, tread)));
    all.push_back(with(test::everything("undamped", 6, 90)));
    all.back().disk.alpha = all.back().disk.beta = 0.0;
    all.push_back(with(test::everything("restitution", 6, 90)));
    all.back().law = {0.3, 0.5};
    all.back().ground->profile = test::ledge().profile;
    all.push_back(with(test::everything("frictionless", 6, 90)));
    all.back().law = {};
    all.push_back(with(test::everything("columns_61", 4, 61)));
  }
  all.push_back(test::pressed(test::sharp(test::everything("smooth", 6, 90))));
  all.push_back(test::pressed(test::sharp(test::everything("treaded", 3, tread))));
  // Pressures on a loaded rim are the general step's.
  for (std::size_t k = 0, n = all.size(); k < n; ++k)
    if (!all[k].pressed) all.push_back(on_loaded_rim(all[k]));
  for (test::RollingCase& c : all) c.disk.motion.start_x = -0.02;
  return all;
}

class Exceptions : public testing::TestWithParam<std::tuple<test::RollingCase, StiffnessOperator>> {
};

}  // namespace

TEST_P(Exceptions, AreThoseOfTheGeneralStep) {
  const auto& [c, of] = GetParam();
  const test::Built b = test::build(c);
  const Model model = test::model_with(b, of);
  ASSERT_EQ(step_of(model), of == StiffnessOperator::cyclic ? StepKind::cyclic : StepKind::sparse);
  const std::vector<Vec2> u = test::some_displacement(b), v = test::some_velocity(b);
  test::Reference general(b.model, start(b.model, u, v));
  State state = start(model, u, v);
  const auto fused = make_integrator(model, state);
  using Contacts = test::Comparison::Contacts;
  const bool sharp = !b.model.contact->ground.corners().empty();
  test::Comparison comparison(sharp ? Contacts::by_node : Contacts::one_by_one);
  std::array<StepReport, 1> report;
  int clusters = 0, nodes = 0;
  for (int n = 0; n < 400; ++n) {
    const StepReport& expected = general.step();
    fused->advance(report, &state);
    comparison.see(expected, report[0]);
    comparison.see(general.state, state);
    ASSERT_EQ(expected.contact.clusters, report[0].contact.clusters) << n;
    ASSERT_EQ(expected.contact.cluster_largest, report[0].contact.cluster_largest) << n;
    ASSERT_FALSE(HasFatalFailure());
    ASSERT_EQ(report[0].contact.unseen, 0.0);
    clusters += report[0].contact.clusters;
    nodes += report[0].contact.nodes;
  }
  EXPECT_GT(nodes, 0);
  EXPECT_EQ(clusters > 0, sharp);
  const Balance &ours = report[0].balance, &theirs = general.last.balance;
  EXPECT_EQ(ours.works.load != 0.0, c.pressed);
  EXPECT_NEAR(ours.works.load, theirs.works.load, 1e-10 * theirs.exchanged);
  EXPECT_LT(ours.relative, 3e-14);
  comparison.expect_within(1e-9);
}

/// A pressure of many times the modulus, at once: the boundary is farther than was looked at. In
/// the report of the batch's own last step, before anything of it can be kept; with a corner near
/// or not, but for corners that are out of reach.
TEST(HeldExceptions, AMotionThatMayMissACornerIsTold) {
  for (const auto& [depth, is_told] : {std::pair{0.0, true}, {0.02, true}, {50.0, false}})
    for (const StiffnessOperator of : test::both_operators) {
      test::RollingCase c = test::pressed(test::sharp(test::everything("", 6, 90)));
      for (Vec2& p : c.ground->profile) p.y -= depth;
      const test::Built b = test::build(c);
      Model model = test::model_with(b, of);
      const State at_start = test::start_at_rest(model);
      std::vector<StepReport> reports(16);
      make_integrator(model, at_start)->advance(reports);
      for (const StepReport& report : reports) EXPECT_EQ(report.contact.unseen, 0.0);
      for (auto& on : model.pressures) on.pressure = Table(1e9);
      make_integrator(model, at_start)->advance(reports);
      EXPECT_EQ(reports.back().contact.unseen > 1e-3, is_told) << depth;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Exceptions,
                         testing::Combine(testing::ValuesIn(cases()),
                                          testing::ValuesIn(test::both_operators)),
                         [](const auto& p) {
                           return test::name(std::get<0>(p.param).name.c_str(),
                                             std::get<1>(p.param));
                         });

}  // namespace held_exceptions_test
