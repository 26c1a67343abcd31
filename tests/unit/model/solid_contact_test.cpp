// SPDX-License-Identifier: BSD-3-Clause
/// Contacts of one node in frames of their own: what holds in one direction holds in each.
#include "rondo/model/solid/solid_contact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rondo/model/solid/wheel_ground.hpp"
#include "support/solid_wheel.hpp"

namespace solid_contact_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// A vector turned about n.
Vec3 turned(Vec3 a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * a.x + s * a.z, a.y, c * a.z - s * a.x};
}

struct Found {
  Vec3 after, impulse;
  ContactReport report;
};

/// A node that falls at rest of the rim onto one facet, or into the corner of two, seen in a frame
/// that is turned about n.
Found solve(const Model& model, Vec3 free, int facets, double angle) {
  const SolidContactStep step(model, frame_step(model.motion, 0, model.dt));
  const contact::Ground corner({.profile = {{-1.0, 0.0}, {0.0, 0.0}, {1.0, 0.4}}});
  const Vec2 place = facets == 2 ? Vec2{-1e-4, -1e-3} : Vec2{-0.5, -1e-3};
  contact::SpaceTouches touches = contact::extruded(corner.touches(place));
  EXPECT_EQ(touches.count, facets);
  for (contact::SpaceTouch& touch : touches.at)
    touch.frame = {turned(touch.frame.normal, angle), turned(touch.frame.line, angle)};
  const SolidContactNode node{
      3, 0.2, 1e-4, {}, turned({0.1, -1.0, 0.3}, angle), turned(free, angle), {}};
  std::array<ActiveContact, 2> contacts;
  Found out;
  out.after = solve_contacts(
      step, node, touches, std::span(contacts).first(static_cast<std::size_t>(facets)), out.report);
  for (int i = 0; i < facets; ++i) {
    const ActiveContact& c = contacts[static_cast<std::size_t>(i)];
    EXPECT_GE(c.impulse.x, 0.0);
    out.impulse += c.space.from(c.impulse);
  }
  return out;
}

Model resting_model() {
  test::Cornering still;
  still.angular_velocity = 0.0;
  Model m = test::cornering_model(mesh::make_wheel(test::box_wheel(1, 1, 12)), still);
  m.motion.speed = Table(0.0);
  return m;
}

}  // namespace

TEST(SolidContact, IsTheSameInEachDirection) {
  Model model = resting_model();
  for (const double friction : {0.0, 0.3, 2.0})
    for (const int facets : {1, 2})
      for (const Vec3 free : {Vec3{0.7, -1.2, 0.4}, Vec3{0.1, -2.0, -0.05}, Vec3{2.0, -0.3, 1.0}}) {
        model.contact->law = {.friction = friction};
        const Found expected = solve(model, free, facets, 0.0);
        EXPECT_GT(norm(expected.impulse), 0.0);
        EXPECT_LT(expected.report.residual, 1e-11);
        for (const double angle : {0.3, 1.2, -2.5}) {
          const Found found = solve(model, free, facets, angle);
          EXPECT_LT(norm(found.after - turned(expected.after, angle)), 1e-11);
          EXPECT_LT(norm(found.impulse - turned(expected.impulse, angle)), 1e-11);
          EXPECT_LT(norm(found.report.impulse - turned(expected.report.impulse, angle)), 1e-11);
          EXPECT_NEAR(found.report.dissipation_friction, expected.report.dissipation_friction,
                      1e-11);
          EXPECT_NEAR(found.report.loss_impact, expected.report.loss_impact, 1e-11);
        }
      }
}

TEST(SolidContact, AProfileIsExtrudedWithItsOwnTangents) {
  const contact::Ground ground({.profile = {{-1.0, 0.0}, {0.0, 0.0}, {1.0, 0.4}}});
  for (const Vec2 place : {Vec2{-0.5, -0.01}, Vec2{-1e-4, -1e-3}, Vec2{0.5, 0.1}, Vec2{0.2, 0.3}}) {
    const contact::Touches plane = ground.touches(place);
    const contact::SpaceTouches space = contact::extruded(plane);
    ASSERT_EQ(space.count, plane.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(plane.count); ++i) {
      EXPECT_EQ(space.at[i].gap, plane.at[i].gap);
      EXPECT_EQ(space.at[i].frame.normal, Vec3(plane.at[i].normal));
      EXPECT_EQ(space.at[i].frame.tangent(), Vec3(turn90(plane.at[i].normal)));
      EXPECT_EQ(space.at[i].frame.line, Vec3(0.0, 0.0, 1.0));
    }
  }
}

/// Ground of another kind is asked in place of the profile.
TEST(SolidContact, GroundInSpaceStandsForTheProfile) {
  class Wall final : public contact::SpaceGround {
   public:
    [[nodiscard]] contact::SpaceTouches touches(Vec3 place) const noexcept override {
      contact::SpaceTouches out;
      if (place.z > 0.0) return out;
      out.count = 1;
      out.at[0].gap = place.z;
      return out;
    }
    [[nodiscard]] double clearance(Vec3 place) const noexcept override { return place.z; }
    [[nodiscard]] double top(double from, double to) const noexcept override { return to - from; }
  };
  ContactModel contact{contact::Ground({}), {}, {}, {}};
  const Vec3 place{0.0, -0.5, 0.25};
  EXPECT_EQ(touches_in_space(contact, place).count, 1);
  EXPECT_EQ(distance_in_space(contact, place), -0.5);
  EXPECT_EQ(top_between(contact, 1.0, 3.0), 0.0);
  contact.space = std::make_shared<const Wall>();
  EXPECT_EQ(touches_in_space(contact, place).count, 0);
  EXPECT_EQ(distance_in_space(contact, place), 0.25);
  EXPECT_EQ(distance_in_space(contact, {0.0, 0.5, -0.125}), -0.125);
  EXPECT_EQ(top_between(contact, 1.0, 3.0), 2.0);
}

}  // namespace solid_contact_test
