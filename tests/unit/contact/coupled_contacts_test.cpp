// SPDX-License-Identifier: BSD-3-Clause
/// Contacts that are solved together, step after step: their problem, and what a step leaves.
#include "rondo/contact/coupled/coupled_contacts.hpp"

#include <gtest/gtest.h>

namespace rondo::contact::coupled_contacts_test {
namespace {

/// Two contacts that press and slide, each pushed a little by the other.
void fill(CoupledContacts& contacts, Vec2 start) {
  contacts.clear();
  contacts.add({-1.0, 5.0}, 0.25, 0.5, start);
  contacts.add({-2.0, -7.0}, 0.0, 0.125, start);
  contacts.couple_all([](std::size_t j, std::size_t l) {
    return j == l ? Block{2.0, 0.0, 0.0, 1.0 + 2.0 * static_cast<double>(j)}
                  : Block{0.5, 0.0, 0.0, 0.0};
  });
}

TEST(CoupledContacts, PutTheirProblemTogether) {
  CoupledContacts contacts({});
  for (int again = 0; again < 2; ++again) {
    fill(contacts, {});
    const CoupledProblem& p = contacts.problem;
    EXPECT_EQ(p.row_start, (std::vector<int>{0, 2, 4}));
    EXPECT_EQ(p.column, (std::vector<int>{0, 1, 0, 1}));
    EXPECT_EQ(p.mass, (std::vector<double>{0.5, 1.0 / 3.0}));
    EXPECT_EQ(p.bounce, (std::vector<double>{0.25, 0.0}));
    ASSERT_EQ(p.blocks.size(), 4U);
    EXPECT_EQ(p.blocks[2], (Block{0.5, 0.0, 0.0, 0.0}));
  }
}

/// w_n = -bounce at both: 2 a + b/2 = 1 - 1/4, a/2 + 2 b = 2; they slide, so |r_t| = μ r_n.
TEST(CoupledContacts, SolveTheirProblem) {
  CoupledContacts contacts({});
  fill(contacts, {});
  EXPECT_TRUE(contacts.solve().converged);
  const double a = 2.0 / 15.0, b = 29.0 / 30.0;
  EXPECT_NEAR(contacts.impulse[0].x, a, 1e-12);
  EXPECT_NEAR(contacts.impulse[0].y, -0.5 * a, 1e-12);
  EXPECT_NEAR(contacts.impulse[1].x, b, 1e-12);
  EXPECT_NEAR(contacts.impulse[1].y, 0.125 * b, 1e-12);
  EXPECT_EQ(contacts.status, (std::vector<Status>{Status::slip, Status::slip}));
  EXPECT_TRUE(contacts.difficult.take().empty());
}

/// What was found is the start of a solution with other free velocities.
TEST(CoupledContacts, GoOnFromWhatTheyFound) {
  CoupledContacts contacts({}, 0), difficult({}, 1);
  fill(contacts, {});
  fill(difficult, {9.0, 9.0});
  (void)contacts.solve();
  const std::vector<Vec2> found = contacts.impulse;
  (void)contacts.solve();
  EXPECT_EQ(contacts.start, found);
  (void)difficult.solve();
  const std::vector<ProblemFile> kept = difficult.difficult.take();
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].start, (std::vector<Vec2>(2, {9.0, 9.0})));
  EXPECT_EQ(kept[0].impulse, difficult.impulse);
}

TEST(CoupledContacts, KeepImpulsesByKey) {
  CoupledContacts contacts({});
  contacts.kept = {{7, {1.0, 2.0}}, {3, {4.0, 5.0}}};
  contacts.sort_kept();
  EXPECT_EQ(contacts.kept_of(7), (Vec2{1.0, 2.0}));
  EXPECT_EQ(contacts.kept_of(3), (Vec2{4.0, 5.0}));
  for (const std::uint64_t other : {0U, 5U, 8U}) EXPECT_EQ(contacts.kept_of(other), Vec2{});
}

}  // namespace
}  // namespace rondo::contact::coupled_contacts_test
