// SPDX-License-Identifier: BSD-3-Clause
/// The table of what goes with what: it is in order, and has an answer for every set of features.
#include "rondo/model/steps/step_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>

namespace rondo::dynamics::step_table_test {
namespace {

constexpr Features last = has::friction_law;

bool is_refused(Features all) {
  return std::ranges::any_of(step_limits(), [&](const Limit& limit) {
    return limit.is_refusal() && limit.holds_for(all);
  });
}

TEST(StepTable, HasItsStepsInTheirOrder) {
  for (std::size_t k = 0; k < step_rows().size(); ++k)
    EXPECT_EQ(static_cast<std::size_t>(step_rows()[k].kind), k);
  EXPECT_EQ(static_cast<std::size_t>(StepKind::solid_reduced) + 1, step_rows().size());
}

TEST(StepTable, NamesEachFeatureAndEachLimitOfSomeSteps) {
  const auto is_named = [](Features of) { return !name_of(of).empty(); };
  for (Features one = 1; one <= last; one <<= 1U)
    EXPECT_TRUE(is_named(one)) << std::countr_zero(one);
  for (const Limit& limit : step_limits()) {
    EXPECT_EQ(std::popcount(limit.at), 1) << limit.why;
    EXPECT_FALSE(limit.why.empty());
    if (limit.is_refusal())
      EXPECT_TRUE(std::popcount(limit.with) == 1 || is_named(limit.with)) << limit.why;
    else
      EXPECT_TRUE(is_named(limit.at | limit.with)) << limit.why;
  }
}

TEST(StepTable, RefusesNothingTwice) {
  std::set<Features> seen;
  for (const Limit& limit : step_limits())
    EXPECT_TRUE(!limit.is_refusal() || seen.insert(limit.at | limit.with).second) << limit.why;
}

/// Whoever adds a feature or a limit adds what it does not go with.
TEST(StepTable, HasAStepOrASentenceForEverySetOfFeatures) {
  constexpr Features of_no_step = has::camber | has::restitution | has::energy_safe |
                                  has::stiffness_damping | has::stress_stiffening |
                                  has::plane_stress | has::reduced;
  std::size_t done = 0;
  for (Features all = 0; all < 2 * last; ++all) {
    const bool hati_alone = (all & has::hati) != 0 && (all & has::other_scheme) == 0;
    if ((all & of_no_step) != 0 || hati_alone) continue;
    ASSERT_NE(choose_step(all) != nullptr, is_refused(all)) << all;
    done += choose_step(all) != nullptr ? 1 : 0;
  }
  EXPECT_GT(done, 100U);
}

TEST(StepTable, ChoosesTheFastestStep) {
  const auto kind = [](Features all) { return choose_step(all)->kind; };
  EXPECT_EQ(kind(0), StepKind::cyclic);
  EXPECT_EQ(kind(has::pressure | has::sharp_corners | has::implicit), StepKind::cyclic);
  EXPECT_EQ(kind(has::loaded_rim | has::sharp_corners), StepKind::cyclic);
  EXPECT_EQ(kind(has::loaded_rim | has::pressure), StepKind::wheel);
  EXPECT_EQ(kind(has::assembled), StepKind::sparse);
  EXPECT_EQ(kind(has::rubber | has::pressure), StepKind::sparse);
  EXPECT_EQ(kind(has::rubber | has::pressure | has::sharp_corners), StepKind::general);
  EXPECT_EQ(kind(has::free_bodies), StepKind::bodies);
  EXPECT_EQ(kind(has::body_contact | has::implicit), StepKind::general);
  EXPECT_EQ(kind(has::body_contact | has::loaded_rim), StepKind::wheel);
  EXPECT_EQ(kind(has::other_scheme), StepKind::general);
  EXPECT_EQ(kind(has::hati | has::other_scheme), StepKind::hati);
  EXPECT_EQ(kind(has::three_dimensions | has::camber), StepKind::solid_cyclic);
  EXPECT_EQ(kind(has::three_dimensions | has::loaded_rim | has::nonlinear_cords),
            StepKind::solid_cyclic);
  EXPECT_EQ(kind(has::three_dimensions | has::nonlinear_cords | has::nonlinear_ogden),
            StepKind::solid);
  EXPECT_EQ(kind(has::three_dimensions | has::loaded_rim | has::friction_law),
            StepKind::solid_cyclic);
}

TEST(StepTable, TellsWhyNotTheFasterSteps) {
  EXPECT_EQ(step_text(0), "fused cyclic");
  EXPECT_EQ(step_text(has::three_dimensions), "fused 3-D cyclic");
  EXPECT_EQ(step_text(has::mesh_file), "fused sparse (not fused cyclic: plane mesh from a file)");
  EXPECT_EQ(step_text(has::body_contact | has::implicit),
            "general (not fused cyclic, fused sparse: contact between bodies; not fused bodies: "
            "implicit elements)");
  EXPECT_EQ(
      step_text(has::three_dimensions | has::loaded_rim | has::friction_law | has::sharp_corners),
      "general 3-D on a loaded rim (not fused 3-D cyclic: friction that is not constant, "
      "with sharp corners of the ground; not general 3-D: rim that forces move)");
}

}  // namespace
}  // namespace rondo::dynamics::step_table_test
