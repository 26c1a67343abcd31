// SPDX-License-Identifier: BSD-3-Clause
/// What must have been built before a step is made, and of what size.
#include <gtest/gtest.h>

#include <string>

#include "integrator_cases.hpp"
#include "rondo/integrators/fused/cyclic_plan.hpp"
#include "rondo/model/saved_state.hpp"
#include "support/stepping.hpp"

namespace contracts_test {

using namespace rondo;
using namespace rondo::dynamics;

TEST(Contracts, AStateOfAnotherBodyMakesNoIntegrator) {
  const Model model =
      test::model_with(test::build(test::everything("", 3, 21)), StiffnessOperator::sparse);
  State other = test::start_at_rest(model);
  other.v_next = Field(model.n_nodes() - 1, 2);
  EXPECT_DEATH((void)make_integrator(model, other), "start.v_next.size");
}

TEST(Contracts, AModelWithoutAStepMakesNoIntegrator) {
  Model model =
      test::model_with(test::build(test::everything("", 3, 21)), StiffnessOperator::sparse);
  const State start = test::start_at_rest(model);
  model.dt = 0.0;
  EXPECT_DEATH((void)make_integrator(model, start), "model.dt > 0.0.*values: 0 ");
}

/// What is saved with stiffness damping has K u.
TEST(Contracts, WithoutItsForcesAStepIsNotRestored) {
  for (const StiffnessOperator of : test::both_operators) {
    Model model = test::model_with(test::build(test::everything("", 3, 21)), of);
    model.stiffness_damping = 1e-6;
    const auto integrator = make_integrator(model, test::start_at_rest(model));
    SavedState saved = integrator->resumable()->save();
    ASSERT_EQ(saved.force.size(), model.n_nodes());
    integrator->resumable()->restore(saved);
    saved.force = Field();
    EXPECT_DEATH(integrator->resumable()->restore(saved), "saved.force.size");
  }
}

TEST(Contracts, ARingIsCutForOneThreadAtLeast) {
  RingLayout layout;
  layout.n_sectors = 40;
  layout.group_columns = 32;
  cut_ring(1, 4, {}, layout);
  EXPECT_EQ(layout.cut.chunks.size(), 1U);
  EXPECT_DEATH(cut_ring(0, 4, {}, layout), "threads >= 1.*values: 40 32 0");
}

}  // namespace contracts_test
