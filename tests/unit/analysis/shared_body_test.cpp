// SPDX-License-Identifier: BSD-3-Clause
/// Runs of a sweep that share a body have the bits of runs that are built alone.
#include <gtest/gtest.h>

#include "rondo/analysis/build/build.hpp"
#include "unit/case/case_fixture.hpp"
#include "unit/case/key_cases.hpp"

namespace shared_body_test {

using namespace rondo::study;

namespace {

const std::vector<std::string> small{"disk.mesh.radial=2", "disk.mesh.circumferential=24"};

Case with(std::vector<std::string> settings) {
  settings.insert(settings.begin(), small.begin(), small.end());
  return test::read_text(test::base, settings);
}

void expect_same(const Setup& a, const Setup& b) {
  EXPECT_EQ(a.model.mass, b.model.mass);
  EXPECT_EQ(a.model.dt, b.model.dt);
  EXPECT_EQ(a.n_steps, b.n_steps);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.critical.step, b.critical.step);
  EXPECT_EQ(a.model.mass_damping, b.model.mass_damping);
  EXPECT_EQ(a.model.stiffness_damping, b.model.stiffness_damping);
  EXPECT_EQ(a.model.motion.angular_velocity.points(), b.model.motion.angular_velocity.points());
  EXPECT_EQ(a.model.motion.height.points(), b.model.motion.height.points());
  ASSERT_EQ(a.model.contact.has_value(), b.model.contact.has_value());
  if (!a.model.contact) return;
  EXPECT_EQ(a.model.contact->law.friction.constant(), b.model.contact->law.friction.constant());
  EXPECT_EQ(a.model.contact->law.restitution, b.model.contact->law.restitution);
  EXPECT_EQ(a.model.contact->law.impact, b.model.contact->law.impact);
}

}  // namespace

TEST(SharedBody, GivesTheSetupOfARunAlone) {
  SharedBody shared;
  for (const std::vector<std::string>& settings : std::vector<std::vector<std::string>>{
           {},
           {"ground.friction=0.7", "ground.restitution=0.2", "ground.impact=energy-safe"},
           {"motion.angular_velocity=20", "motion.height=0.4"},
           {"initial.state=stationary", "motion.angular_velocity=20"},
           {"initial.state=stationary", "motion.angular_velocity=20", "damping.mass=3"},
           {"initial.state=stationary", "motion.angular_velocity=30"},
           {"time.end=0.01", "time.safety=0.5"},
           {"material.youngs_modulus=1e7"},
           {"motion.angular_velocity=500"},  // beyond softening
           {"motion.angular_velocity=10"}}) {
    const Case c = with(settings);
    const auto mine = build(c, 1, &shared);
    const auto alone = build(c, 1);
    expect_same(mine, alone);
  }
}

TEST(SharedBody, IsBuiltOnceWhereOnlyFrictionOrMotionDiffer) {
  SharedBody shared;
  static_cast<void>(build(with({}), 1, &shared));
  const double mark = shared.setup.critical.step *= 0.5;
  EXPECT_EQ(build(with({"ground.friction=0.9"}), 1, &shared).critical.step, mark);
  const double whole = build(with({}), 1).critical.step;
  EXPECT_EQ(build(with({"material.density=1101"}), 1, &shared).critical.step,
            build(with({"material.density=1101"}), 1).critical.step);
  EXPECT_EQ(build(with({}), 1, &shared).critical.step, whole);
}

TEST(SharedBody, KeyOfAllThatTheBodyHangsOn) {
  const std::string key = body_key(with({}));
  for (const char* same :
       {"ground.friction=0.9", "ground.restitution=0.5", "motion.speed=3", "motion.height=0.4",
        "motion.start_x=-1", "motion.gravity=9.81", "damping.mass=1", "time.end=1",
        "time.safety=0.3", "title=other", "output.snapshots=3", "initial.state=stationary"})
    EXPECT_EQ(body_key(with({same})), key) << same;
  for (const char* other :
       {"disk.outer_radius=0.31", "disk.mesh.grading=1.5", "material.youngs_modulus=1e7",
        "material.plane=stress", "damping.stiffness=1e-5", "ground.fillet=0.03",
        "solver.operator=sparse", "material.stress_stiffening=centrifugal"})
    EXPECT_NE(body_key(with({other})), key) << other;
}

/// Each key of the table, in each case that has it: the body hangs on it if its row says so.
TEST(SharedBody, KeyHangsOnTheKeysWhoseRowSaysSo) {
  int bound = 0, free = 0;
  for (const CaseKey& key : case_keys())
    for (const Case& c : test::cases_with_every_key()) {
      if (key.path == "schema" || !test::is_written(key, c)) continue;  // there is one schema
      const bool differs = body_key(test::with_another_value(key, c)) != body_key(c);
      EXPECT_EQ(differs, key.use.changes_body(c)) << key.path;
      ++(differs ? bound : free);
    }
  EXPECT_GT(bound, 60);
  EXPECT_GT(free, 60);
}

/// They are points of the body as it is meshed, wherever it starts.
TEST(SharedBody, ProbesOfABodyThatIsMoved) {
  SharedBody shared;
  Case c = test::read_text(test::base, small);
  c.free_rim = true;
  c.motion = {};
  c.initial.position = {3.0, 0.4};
  c.output.probes = {{"rim", {0.2, 0.0}}};
  const auto alone = build(c, 1);
  ASSERT_EQ(alone.probes.size(), 1U);
  for (const double friction : {0.1, 0.2}) {
    c.ground->friction.coefficient = friction;
    const auto mine = build(c, 1, &shared);
    ASSERT_EQ(mine.probes.size(), 1U);
    EXPECT_EQ(mine.probes[0].cell, alone.probes[0].cell);
    EXPECT_EQ(mine.probes[0].weight, alone.probes[0].weight);
  }
}

/// The spin stiffens the body, so that its stiffness hangs on it.
TEST(SharedBody, KeyHoldsTheSpinThatStiffens) {
  const std::string stiff = "material.stress_stiffening=centrifugal";
  EXPECT_NE(body_key(with({stiff, "motion.angular_velocity=10"})),
            body_key(with({stiff, "motion.angular_velocity=11"})));
  EXPECT_EQ(body_key(with({stiff, "motion.speed=10"})), body_key(with({stiff, "motion.speed=11"})));
}

/// Printed as it stands in the paper, α is part of the critical step.
TEST(SharedBody, KeyHoldsTheDampingOfTheSchemeAsPrinted) {
  const std::string printed = "time.scheme=as-printed";
  EXPECT_NE(body_key(with({printed, "damping.mass=1"})),
            body_key(with({printed, "damping.mass=2"})));
}

}  // namespace shared_body_test
