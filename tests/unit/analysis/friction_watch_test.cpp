// SPDX-License-Identifier: BSD-3-Clause
/// The share of friction that alternates, of contacts whose slips are given.
#include "rondo/analysis/friction_watch.hpp"

#include <gtest/gtest.h>

#include "rondo/contact/friction_table.hpp"

namespace rondo::study::friction_watch_test {
namespace {

constexpr double dt = 1e-5, mass = 0.2, length = 0.01;

/// Two contact nodes of a plane body on friction that rises by 0.8 s/m, from 0, to 0.4.
Setup two_nodes() {
  Setup s;
  s.model.dt = dt;
  s.model.reference = {{0.0, 0.0}, {0.1, 0.0}};
  s.model.mass = {mass, mass};
  s.model.contact.emplace(dynamics::ContactModel{
      contact::Ground(contact::GroundShape{}), {}, {0, 1}, {length, length}});
  s.model.contact->law.friction =
      contact::friction_of({.coefficient = 0.4, .slip = {{0.0, 0.0}, {0.5, 1.0}}, .patches = {}});
  s.critical.omega = 5e4;  // the limit is 2 - 0.125
  return s;
}

/// A contact of a node with these slips, and a normal impulse for this κ at a slope of 0.8 s/m.
dynamics::ActiveContact contact_of(std::size_t node, double before, double after, double kappa) {
  dynamics::ActiveContact c;
  c.candidate = node;
  c.before.y = before;
  c.after.y = after;
  c.impulse.x = kappa * mass / 0.8;
  return c;
}

ContactStatistics found_in(const Setup& s, std::vector<dynamics::ActiveContact> contacts) {
  dynamics::State state(s.model);
  state.active = std::move(contacts);
  ContactStatistics found;
  FrictionWatch(s).look(state, found);
  return found;
}

TEST(FrictionWatch, CountsWhatAlternatesAboveTheLimitAlone) {
  const study::Setup s = two_nodes();
  EXPECT_DOUBLE_EQ(FrictionWatch(s).limit().value(), 1.875);
  // The first one alternates between μ = 0 and 0.16; the second slides at 0.32 and less.
  const ContactStatistics above =
      found_in(s, {contact_of(0, 0.0, 0.2, 1.9), contact_of(1, -0.4, -0.3, 1.8)});
  EXPECT_NEAR(above.friction_steepness, 1.9, 1e-12);
  EXPECT_NEAR(alternating_share(above), 1.9 * 0.16 / (1.9 * 0.16 + 1.8 * 0.32), 1e-12);
  const ContactStatistics below =
      found_in(s, {contact_of(0, 0.0, 0.2, 1.85), contact_of(1, -0.4, -0.3, 1.8)});
  EXPECT_EQ(alternating_share(below), 0.0);
  EXPECT_NEAR(below.friction_steepness, 1.85, 1e-12);
}

TEST(FrictionWatch, SlipsBeyondTheTableAndContactsThatStickDoNotAlternate) {
  const study::Setup s = two_nodes();
  const ContactStatistics found =
      found_in(s, {contact_of(0, 0.6, 0.9, 50.0), contact_of(1, 0.0, 0.0, 50.0)});
  EXPECT_EQ(alternating_share(found), 0.0);
  EXPECT_NEAR(found.friction_steepness, 50.0,
              1e-6);  // of the one that sticks, if it began to slide
  EXPECT_TRUE(FrictionWatch(s).warning(found).empty());
}

TEST(FrictionWatch, WarnsAboveAHundredthWithAStepThatBearsIt) {
  const study::Setup s = two_nodes();
  const FrictionWatch watch(s);
  ContactStatistics found;
  found.friction_bearable = 1.0;
  found.friction_alternating = 0.0099;
  found.friction_steepness = 4.0;
  EXPECT_EQ(watch.warning(found), "");
  found.friction_alternating = 0.0101;
  const std::string told = watch.warning(found);
  EXPECT_NE(told.find("1.01 % of the friction alternates"), std::string::npos) << told;
  // 4e5 Δt = 2 - (5e4 Δt)²/2 at 4.93e-6 s
  EXPECT_NE(told.find("time.step of 4.9e-06 s"), std::string::npos) << told;
}

TEST(FrictionWatch, NodesWithoutMassAlternateHoweverLittleTheyArePressed) {
  study::Setup s = two_nodes();
  s.model.lumped_mass = s.model.mass;
  s.model.mass = {0.0, 0.0};
  const ContactStatistics found =
      found_in(s, {contact_of(0, 0.0, 0.2, 1e-9), contact_of(1, 0.3, 0.3, 1e-9)});
  // The second one slides steadily: its coefficients are compared over 1e-6 m/s.
  EXPECT_NEAR(alternating_share(found), 0.16 / (0.16 + 0.8 * (0.3 + 1e-6)), 1e-12);
  const FrictionWatch watch(s);
  EXPECT_FALSE(watch.limit());
  EXPECT_NE(watch.warning(found).find("solver.contact_mass"), std::string::npos);
}

TEST(FrictionWatch, WatchesTablesOfFullRunsAlone) {
  study::Setup s = two_nodes();
  EXPECT_TRUE(FrictionWatch(s).watches());
  s.reduced = "40 modes";
  EXPECT_FALSE(FrictionWatch(s).watches());
  s.reduced.clear();
  s.model.contact->law.friction = 0.4;
  EXPECT_FALSE(FrictionWatch(s).watches());
  EXPECT_EQ(found_in(s, {contact_of(0, 0.0, 0.2, 9.0)}), ContactStatistics());
}

}  // namespace
}  // namespace rondo::study::friction_watch_test
