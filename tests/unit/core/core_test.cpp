// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rondo/core/complex.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/field.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/core/keep_larger.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/core/text/edit_distance.hpp"

namespace core_test {

using namespace rondo;

TEST(Complex, MultipliesAndDivides) {
  const Complex a{1.0, 2.0}, b{-3.0, 0.5};
  EXPECT_EQ(a * b, (Complex{-4.0, -5.5}));
  const Complex quotient = (a * b) / b;
  EXPECT_NEAR(quotient.re, a.re, 1e-15);
  EXPECT_NEAR(quotient.im, a.im, 1e-15);
}

TEST(Complex, TurnsAndScalesVectors) {
  const Vec2 v{1.0, 2.0}, w{-3.0, 0.5};
  const Complex a{1.5, -0.5};
  EXPECT_EQ(a * v, (Vec2{2.5, 2.5}));
  EXPECT_EQ(turn90(v), (Complex{0.0, 1.0} * v));
  EXPECT_NEAR(norm((a * v) / a - v), 0.0, 1e-15);
  const Complex between = rotation_between(v, w);  // conj(v) w
  EXPECT_EQ(between * v, dot(v, v) * w);
}

TEST(Complex, FrameOfANormalIsNormalAndTangent) {
  const Vec2 normal{0.6, 0.8}, tangent = turn90(normal), force{2.0, -3.0};
  EXPECT_EQ(to_frame(normal, force), (Vec2{dot(normal, force), dot(tangent, force)}));
  EXPECT_NEAR(norm(from_frame(normal, to_frame(normal, force)) - force), 0.0, 1e-15);
}

TEST(Complex, SmallRotationKeepsItsDigits) {
  // e^{iθ} - 1 = iθ - θ²/2: by subtraction the real part would be lost altogether.
  const Complex z = rotation_minus_one(1e-9);
  EXPECT_NEAR(z.re, -5e-19, 1e-33);
  EXPECT_NEAR(z.im, 1e-9, 1e-24);
  const Complex big = rotation_minus_one(2.0), direct = rotation(2.0) - Complex{1.0, 0.0};
  EXPECT_NEAR(big.re, direct.re, 1e-15);
  EXPECT_NEAR(big.im, direct.im, 1e-15);
}

TEST(FieldView, ShowsPointsOfAPlaneField) {
  std::vector<Vec2> field{{1.0, 2.0}, {3.0, 4.0}, {5.0, 6.0}};
  const FieldView view = field;
  EXPECT_EQ(view.size(), 3U);
  EXPECT_EQ(view.components, 2U);
  EXPECT_EQ(view[1][0], 3.0);
  EXPECT_EQ(view[2][1], 6.0);
  MutableFieldView(field).values[3] = 7.0;
  EXPECT_EQ(field[1], (Vec2{3.0, 7.0}));
  const FieldView in_space(view.values, 3);
  EXPECT_EQ(in_space.size(), 2U);
  EXPECT_EQ(in_space[1][2], 6.0);
}

TEST(Field, HasTheComponentsItWasMadeWith) {
  Field plane(3, 2), space(3, 3);
  EXPECT_EQ(plane.size(), 3U);
  EXPECT_EQ(space.components(), 3U);
  space.space()[1] = {1.0, 2.0, 3.0};
  const FieldView view = space;
  EXPECT_EQ(view.components, 3U);
  EXPECT_EQ(view[1][2], 3.0);
  MutableFieldView(plane).values[3] = 4.0;
  EXPECT_EQ(plane.plane()[1], (Vec2{0.0, 4.0}));
  EXPECT_NE(plane, space);
  EXPECT_NE(Field(3, 3), space);
  EXPECT_TRUE(Field().plane().empty() && Field().space().empty());
  EXPECT_DEATH(static_cast<void>(plane.space()), "broken contract.*values: 2");
  EXPECT_DEATH(static_cast<void>(space.plane()), "broken contract.*values: 3");
}

/// A state is filled in every batch of steps: that allocates nothing.
TEST(Field, KeepsItsStorageWhereAVectorIsAssigned) {
  Field field(4, 2);
  const Vec2* const storage = field.plane().data();
  const std::vector<Vec2> values(4, Vec2{1.0, 2.0});
  field = values;
  EXPECT_EQ(field.plane().data(), storage);
  Field copy(4, 2);
  const Vec2* const of_copy = copy.plane().data();
  copy = field;
  EXPECT_EQ(copy.plane().data(), of_copy);
  EXPECT_EQ(copy, field);
  field = std::vector<Vec3>(2);
  EXPECT_EQ(field.components(), 3U);
}

/// (t1, n, t2) and the axes of the wheel: a rotation about t1 by the camber.
TEST(GroundFrame, TurnsByTheCamber) {
  const double camber = 0.3;
  const GroundFrame ground(camber);
  const Vec3 normal = ground.to_wheel({0.0, 1.0, 0.0}), across = ground.to_wheel({0.0, 0.0, 1.0});
  EXPECT_EQ(normal, (Vec3{0.0, std::cos(camber), std::sin(camber)}));
  EXPECT_EQ(across, cross(Vec3{1.0, 0.0, 0.0}, normal));
  const Vec3 a{1.0, -2.0, 3.0}, back = ground.from_wheel(ground.to_wheel(a));
  EXPECT_NEAR(norm(back - a), 0.0, 1e-15);
  const Vec3 flat = GroundFrame().to_wheel(a);
  EXPECT_EQ(flat, a);
}

/// A force at a place of the ground, in the axes of the wheel; the center is at their origin.
TEST(GroundFrame, HasTheMomentsAboutTheContactCentre) {
  const double camber = 0.3, height = 0.28;
  const GroundFrame ground(camber);
  const Vec3 normal = ground.to_wheel({0.0, 1.0, 0.0}), heading{1.0, 0.0, 0.0};
  const Vec3 push = ground.to_wheel({3.0, 5.0, -2.0}), at = ground.to_wheel({0.04, -height, 0.06});
  const Vec3 centre{0.0, -height / std::cos(camber), 0.0};  // in the plane of the wheel
  EXPECT_NEAR(ground.from_wheel(centre).y, -height, 1e-15);
  const auto about = [&](Vec3 point) {
    const Vec3 moment = cross(at - point, push);
    return GroundMoments{dot(normal, moment), dot(heading, moment)};
  };
  const GroundMoments below = about(ground.to_wheel({0.0, -height, 0.0})),
                      found = ground.about_contact_centre(below, ground.from_wheel(push), height);
  EXPECT_NEAR(found.aligning, about(centre).aligning, 1e-15);
  EXPECT_NEAR(found.overturning, about(centre).overturning, 1e-15);
  EXPECT_GT(std::abs(found.overturning - below.overturning), 0.1);
  const GroundMoments upright = GroundFrame().about_contact_centre(below, push, height);
  EXPECT_EQ(upright.aligning, below.aligning);
  EXPECT_EQ(upright.overturning, below.overturning);
}

TEST(CompensatedSum, KeepsWhatPlainSumsLose) {
  CompensatedSum sum;
  sum.add(1.0);
  for (int i = 0; i < 1000000; ++i) sum.add(1e-17);
  EXPECT_NEAR(sum.value(), 1.0 + 1e-11, 1e-16);
  CompensatedSum large;
  for (const double x : {1.0, 1e100, 1.0, -1e100}) large.add(x);
  EXPECT_EQ(large.value(), 2.0);
}

TEST(Fault, NamesPlaceKeyFoundAndAllowed) {
  const Fault fault{"a.toml",
                    3,
                    7,
                    "disk.inner_radius",
                    "0.4",
                    "must be below the outer radius",
                    "0 < inner_radius < 0.3"};
  EXPECT_EQ(fault.text(),
            "a.toml:3:7: disk.inner_radius = 0.4: must be below the outer radius (allowed: 0 < "
            "inner_radius < 0.3)");
  Fault second;
  second.message = "second";
  const InputError error({fault, second});
  EXPECT_EQ(error.faults().size(), 2U);
  EXPECT_NE(std::string(error.what()).find("second"), std::string::npos);
}

TEST(Contract, PrintsTheValues) {
  const int n = 3;
  EXPECT_DEATH(RONDO_DEMAND(n == 4, n, 2.5), "broken contract `n == 4`.*values: 3 2.5");
}

TEST(EditDistance, OfNames) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("", "ab"), 2U);
  EXPECT_EQ(edit_distance("height", "HEIGHT"), 0U);
  EXPECT_EQ(edit_distance("height", "hieght"), 1U);
  EXPECT_EQ(edit_distance("height", "heigt"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(KeepLarger, NeverLosesWhatIsNoNumber) {
  const double none = std::nan("");
  EXPECT_TRUE(std::isnan(keep_larger(none, 1.0)));
  EXPECT_TRUE(std::isnan(keep_larger(1.0, none)));
  EXPECT_TRUE(std::isnan(keep_larger(keep_larger(0.0, none), 1e300)));
  EXPECT_EQ(keep_larger(1.0, 2.0), 2.0);
  EXPECT_EQ(keep_larger(2.0, 1.0), 2.0);
}

}  // namespace core_test
