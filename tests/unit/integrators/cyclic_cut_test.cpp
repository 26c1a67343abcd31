// SPDX-License-Identifier: BSD-3-Clause
/// However the ring is cut into chunks and the steps into passes: the same bits as one chunk, one
/// step at a time, which the tests of both operators hold against the reference.
#include <gtest/gtest.h>

#include <string>

#include "integrator_cases.hpp"
#include "rondo/integrators/fused/cyclic_integrator.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "support/stepping.hpp"

namespace cyclic_cut_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Outcome {
  State state;
  std::vector<StepReport> reports;
};

constexpr int steps = 151;  // a last pass that is not full

Outcome after(const test::Built& b, const Model& model, const CyclicTuning& tuning) {
  CyclicIntegrator integrator(model,
                              start(model, test::some_displacement(b), test::some_velocity(b)),
                              kernel_table(), tuning);
  Outcome out{State(model), std::vector<StepReport>(steps)};
  const std::span reports(out.reports);
  integrator.advance(reports.first(7), nullptr);
  integrator.advance(reports.subspan(7, 64), nullptr);
  integrator.advance(reports.subspan(71), &out.state);
  return out;
}

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.state.u, b.state.u);
  EXPECT_EQ(a.state.v, b.state.v);
  EXPECT_EQ(a.state.v_next, b.state.v_next);
  ASSERT_EQ(a.state.active.size(), b.state.active.size());
  for (std::size_t i = 0; i < a.state.active.size(); ++i) {
    EXPECT_EQ(a.state.active[i].candidate, b.state.active[i].candidate);
    EXPECT_EQ(a.state.active[i].impulse, b.state.active[i].impulse);
  }
  for (std::size_t i = 0; i < steps; ++i) {
    ASSERT_EQ(a.reports[i].contact.impulse, b.reports[i].contact.impulse) << i;
    ASSERT_EQ(a.reports[i].contact.nodes, b.reports[i].contact.nodes) << i;
    ASSERT_EQ(a.reports[i].balance.kinetic, b.reports[i].balance.kinetic) << i;
    ASSERT_EQ(a.reports[i].balance.works.frame, b.reports[i].balance.works.frame) << i;
    ASSERT_EQ(a.reports[i].balance.works.load, b.reports[i].balance.works.load) << i;
    ASSERT_EQ(a.reports[i].balance.works.dissipation_stiffness,
              b.reports[i].balance.works.dissipation_stiffness)
        << i;
    ASSERT_EQ(a.reports[i].balance.works.dissipation_friction,
              b.reports[i].balance.works.dissipation_friction)
        << i;
  }
}

std::vector<test::RollingCase> cases() {
  std::vector<test::RollingCase> all;
  // 96 and more, with 0 to 7 columns in the last pack; layers that are no whole strips.
  for (const int columns : {96, 102, 135, 161, 230})
    all.push_back(test::everything("columns_" + std::to_string(columns), 9, columns));
  all.push_back(test::everything("columns_103_without_beta", 6, 103));
  all.back().disk.beta = 0.0;
  all.push_back(test::everything("pitches_70", 4, mesh::Tread{70, 0.02, 3, 1, 2}));
  all.push_back(test::everything("pitches_13", 4, mesh::Tread{13, 0.02, 5, 3, 2}));
  for (const std::size_t i : {0U, 5U, 7U}) {
    all.push_back(test::pressed(all[i]));
    all.push_back(test::sharp(all[i]));
  }
  // Lands of many rows, all of which a step must have done before the next one reads any.
  all.push_back(test::sharp(test::everything("pitches_12", 4, mesh::Tread{12, 0.02, 20, 8, 2})));
  // A step up to the middle of a chunk: its corner is held within a pass of several steps.
  all.push_back(test::sharp(test::everything("columns_390_step", 4, 390)));
  all.back().ground->profile = {{-10, 0}, {0.1665, 0}, {0.1665, 0.03}, {10, 0.03}};
  for (const std::size_t i : {0U, 3U, 5U, 7U}) all.push_back(test::rubbing(all[i]));
  for (test::RollingCase& c : all) c.disk.motion.start_x = 0.02;  // in contact from the start
  return all;
}

class CyclicCuts : public testing::TestWithParam<test::RollingCase> {};

}  // namespace

TEST_P(CyclicCuts, GiveTheSameBitsOnAnyNumberOfThreads) {
  const test::Built b = test::build(GetParam());
  Model model = test::model_with(b, StiffnessOperator::cyclic);
  CyclicTuning in_cache;
  in_cache.cache_bytes = std::size_t{1} << 40U;
  const Outcome whole = after(b, model, in_cache);
  EXPECT_EQ(make_cyclic_plan(model, in_cache).cut.halo, Halo::ring);
  EXPECT_EQ(make_cyclic_plan(model, in_cache).cut.depth, 1);
  long contacts = 0, clusters = 0;
  for (const StepReport& report : whole.reports) {
    contacts += report.contact.nodes;
    clusters += report.contact.clusters;
  }
  EXPECT_GT(contacts, 0);
  EXPECT_EQ(clusters > 0, GetParam().ground->fillet == 0.0);
  EXPECT_LT(whole.reports.back().balance.relative, 3e-14);
  const CyclicTuning ring{0, 1 << 20, 8}, wide{0, 32, 8}, wider{0, 96, 8}, narrow{0, 32, 1 << 20};
  for (const CyclicTuning& tuning : {ring, wide, wider, narrow})
    for (const int threads : {1, 2, 3}) {
      model.threads = threads;
      const CyclicPlan plan = make_cyclic_plan(model, tuning);
      SCOPED_TRACE(std::to_string(plan.cut.chunks.size()) + " chunks, " +
                   std::to_string(plan.cut.depth) + " steps in a pass, " + std::to_string(threads) +
                   " threads");
      expect_same(whole, after(b, model, tuning));
    }
}

INSTANTIATE_TEST_SUITE_P(All, CyclicCuts, testing::ValuesIn(cases()),
                         [](const auto& p) { return p.param.name; });

/// The cuts of the test above are those that large disks take.
TEST(CyclicCut, LargeDisksTakeSeveralStepsInAPassOverWideChunks) {
  const test::Built b = test::build(test::everything("wide", 9, 230));
  Model model = test::model_with(b, StiffnessOperator::cyclic);
  const CyclicPlan wide = make_cyclic_plan(model, {0, 32, 8});
  EXPECT_EQ(wide.cut.halo, Halo::wide);
  EXPECT_EQ(wide.cut.depth, most_steps_in_a_pass);
  EXPECT_GT(wide.cut.chunks.size(), 4U);
  EXPECT_EQ(make_cyclic_plan(model, {0, 1 << 20, 8}).cut.depth, most_steps_in_a_pass);
  EXPECT_EQ(make_cyclic_plan(model, {0, 32, 1 << 20}).cut.halo, Halo::narrow);
  model.threads = 2;
  EXPECT_EQ(make_cyclic_plan(model).cut.chunks.size(), 2U);
}

}  // namespace cyclic_cut_test
