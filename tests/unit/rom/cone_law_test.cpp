// SPDX-License-Identifier: BSD-3-Clause
/// The law of contact of reduced wheels in space: forces judged by the natural map in double, and
/// by solvers that share no code with it.
#include "rondo/rom/solid/cone_law.hpp"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "cone_problems.hpp"
#include "rolling_box.hpp"

namespace rondo::rom {
namespace cone_law_test {
using namespace cone_problems;
using contact::Status;
using rolling_box::BoxWheel, rolling_box::RollingBox;

ConeLaw::Report solve(ConeLaw& law, Problem& p) {
  return law.solve(p.contacts, p.window, p.window.size());
}
ConeLaw::Report solve(Problem& p, double tolerance) {
  ConeLaw law(tolerance);
  return solve(law, p);
}
int count(const Problem& p, Status status) {
  return static_cast<int>(std::ranges::count(p.contacts, status, &ConeContact::status));
}
/// Largest difference of two forces over the largest.
double apart(const VectorXd& a, const VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

class RandomCones : public testing::TestWithParam<std::tuple<double, bool>> {
 protected:
  [[nodiscard]] static Problem problem(unsigned seed) {
    return random_problem(seed,
                          {.friction = std::get<0>(GetParam()), .rim = std::get<1>(GetParam())});
  }
};

TEST_P(RandomCones, ResidualIsBelowTheTolerance) {
  for (const double tolerance : {1e-6, 1e-10})
    for (unsigned seed = 0; seed < 20; ++seed) {
      Problem p = problem(seed);
      const ConeLaw::Report report = solve(p, tolerance);
      EXPECT_FALSE(report.by_newton) << seed;
      EXPECT_LT(report.sweeps, std::get<0>(GetParam()) < 1.0 ? 100 : 300) << seed;
      EXPECT_LE(missed(p), tolerance) << seed;
      EXPECT_NEAR(missed(p), report.residual, 1e-12) << seed;
      EXPECT_GT(count(p, Status::open), 0) << seed;
      EXPECT_LT(count(p, Status::open), 20) << seed;
    }
}

TEST_P(RandomCones, ForcesAreThoseOfALongProjection) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    Problem p = problem(seed);
    solve(p, 1e-10);
    EXPECT_LT(apart(forces_of(p), by_projection(p, 3000)), 1e-8) << seed;
  }
}

TEST_P(RandomCones, NodesMoveAsTheForcesMoveThem) {
  Problem p = problem(1);
  ConeLaw law(1e-6);
  solve(law, p);
  const VectorXd u = moved_by(p, forces_of(p));
  VectorXd pressed = VectorXd::Zero(p.compliance.cols());
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    const ConeContact& c = p.contacts[i];
    EXPECT_LT((vector_of(c.moved) - u.segment<3>(static_cast<Index>(3 * i))).norm(), 1e-15);
    pressed.segment<3>(Index{3} * c.place) = vector_of(turned_back(c, vector_of(c.force)));
  }
  const VectorXd all = p.compliance * pressed;
  const std::span<const double> moved = law.moved();
  ASSERT_EQ(static_cast<Index>(moved.size()), all.size());
  for (Index i = 0; i < all.size(); ++i) EXPECT_NEAR(moved[at(i)], all[i], 1e-16) << i;
}

/// Sweeps that are stopped early leave the rest to Newton's method, which begins at their forces.
TEST_P(RandomCones, NewtonFindsTheForcesOfTheSweeps) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Problem p = problem(seed), q = p;
    solve(p, 1e-10);
    ConeLaw few(1e-10, cone_table(), 3);
    const ConeLaw::Report report = solve(few, q);
    EXPECT_TRUE(report.by_newton) << seed;
    EXPECT_LE(missed(q), 1e-10) << seed;
    EXPECT_LT(apart(forces_of(q), forces_of(p)), 1e-8) << seed;
  }
}

TEST_P(RandomCones, AllInstructionSetsFindTheSameBits) {
  for (const double tolerance : {1e-6, 1e-10}) {
    std::vector<VectorXd> found;
    for (const kernels::ConeTable* table : cone_tables())
      for (int turn = 0; turn < 2; ++turn) {
        Problem p = problem(3);
        ConeLaw law(tolerance, *table);
        solve(law, p);
        found.push_back(forces_of(p));
        p = problem(3);
        solve(law, p);  // the same law once more
        found.push_back(forces_of(p));
      }
    for (const VectorXd& forces : found) EXPECT_EQ(forces, found.front());
  }
}

TEST_P(RandomCones, ForcesThatMeetTheLawAreKept) {
  Problem p = problem(4);
  solve(p, 1e-6);
  const VectorXd forces = forces_of(p);
  EXPECT_EQ(solve(p, 1e-6).sweeps, 0);
  EXPECT_LT(apart(forces_of(p), forces), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Frictions, RandomCones,
                         testing::Combine(testing::Values(0.0, 0.3, 0.9, 2.0), testing::Bool()),
                         [](const auto& info) {
                           return "Friction" + std::to_string(info.index / 2) +
                                  (std::get<1>(info.param) ? "WithRim" : "");
                         });

TEST(ConeLaw, OfOneContactIsThatOfTheContactPair) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Problem p = random_problem(seed, {.contacts = 1, .friction = 0.1 * (seed % 10)});
    const MatrixXd a = dense(p);
    contact::SpatialProblem pair;
    pair.free = p.contacts[0].free;
    for (Index k = 0; k < 3; ++k) pair.delassus[at(k)] = plain(a.row(k).transpose());
    solve(p, 1e-12);
    const auto expected = contact::solve_spatial(pair, p.contacts[0].friction);
    ASSERT_TRUE(expected.converged);
    EXPECT_LT(norm(p.contacts[0].force - expected.impulse), 1e-9 * (1.0 + norm(expected.impulse)))
        << seed;
    EXPECT_EQ(p.contacts[0].status, expected.status) << seed;
  }
}

TEST(ConeLaw, WithoutFrictionTheClosedContactsSolveALinearSystem) {
  Problem p = random_problem(7, {.contacts = 40, .friction = 0.0});
  solve(p, 1e-12);
  const MatrixXd a = dense(p);
  std::vector<Index> closed;
  for (std::size_t i = 0; i < p.contacts.size(); ++i)
    if (p.contacts[i].force.x > 0.0) closed.push_back(static_cast<Index>(3 * i));
  ASSERT_GT(closed.size(), 10U);
  const VectorXd free = moved_by(p, VectorXd::Zero(a.rows()))(closed);
  const VectorXd normal = MatrixXd(a(closed, closed)).partialPivLu().solve(-free);
  EXPECT_LT(apart(forces_of(p)(closed), normal), 1e-10);
}

TEST(ConeLaw, WithoutContactsNothingMoves) {
  Problem p = random_problem(0, {});
  p.contacts.clear();
  ConeLaw law(1e-6);
  EXPECT_EQ(solve(law, p).residual, 0.0);
  EXPECT_TRUE(std::ranges::all_of(law.moved(), [](double x) { return x == 0.0; }));
}

TEST(ConeTable, SumsAndColumnsAreThoseOfPlainLoops) {
  std::mt19937 numbers(1);
  std::uniform_real_distribution<float> any(-1.0F, 1.0F);
  const std::ptrdiff_t n = 480;
  Eigen::MatrixXf rows = Eigen::MatrixXf::NullaryExpr(n, 3, [&] { return any(numbers); });
  Eigen::VectorXf by = Eigen::VectorXf::NullaryExpr(n, [&] { return any(numbers); });
  const MatrixXd columns = rows.cast<double>() * 1.1;
  const double factors[] = {0.3, -0.7, 0.9};
  const Vector3d expected = rows.cast<double>().transpose() * by.cast<double>();
  const VectorXd added = columns * Vector3d(0.3, -0.7, 0.9) + VectorXd::Ones(n);
  std::vector<Eigen::Vector3f> sums;
  for (const kernels::ConeTable* table : cone_tables()) {
    table->sums(rows.data(), n, by.data(), n, sums.emplace_back().data());
    EXPECT_LT((sums.back().cast<double>() - expected).norm(), 1e-5) << table->name;
    EXPECT_EQ(sums.back(), sums.front()) << table->name;
    VectorXd to = VectorXd::Ones(n);
    const double* three[] = {columns.col(0).data(), columns.col(1).data(), columns.col(2).data()};
    table->add(three, factors, n - 3, to.data());
    EXPECT_LT((to - added).head(n - 3).norm(), 1e-13) << table->name;
    EXPECT_EQ(to.tail(3), VectorXd::Ones(3)) << table->name;
  }
}

class WheelWindow : public testing::TestWithParam<double> {
 protected:
  [[nodiscard]] static Problem problem() {
    static const BoxWheel wheel;
    return window_problem(wheel.ring, GetParam());
  }
};

TEST_P(WheelWindow, ColumnsAndRowsAreThoseOfTheWholeMatrix) {
  const Problem p = problem();
  ASSERT_EQ(p.window.size(), p.compliance.rows());
  for (Index j = 0; j < p.window.size(); ++j)
    for (Index i = 0; i < p.window.size(); ++i) {
      ASSERT_EQ(p.window.column(j)[i], p.compliance(i, j)) << i << ' ' << j;
      ASSERT_EQ(p.window.rounded(i)[j], static_cast<float>(p.compliance(i, j))) << i << ' ' << j;
    }
}

TEST_P(WheelWindow, IsSolvedToTheTolerance) {
  for (const double tolerance : {1e-6, 1e-10}) {
    Problem p = problem();
    const ConeLaw::Report report = solve(p, tolerance);
    EXPECT_FALSE(report.by_newton);
    EXPECT_LE(missed(p), tolerance);
    EXPECT_GT(count(p, Status::open), 0);
    EXPECT_GE(count(p, Status::slip) + count(p, Status::stick), 15);
  }
}

TEST_P(WheelWindow, ForcesAreThoseOfALongProjection) {
  Problem p = problem();
  solve(p, 1e-10);
  EXPECT_LT(apart(forces_of(p), by_projection(p, 20000)), 1e-6);
}

TEST_P(WheelWindow, IsSolvedByNewtonWhereSweepsAreTooFew) {
  Problem p = problem(), q = p;
  solve(p, 1e-10);
  ConeLaw few(1e-10, cone_table(), 8);
  EXPECT_TRUE(solve(few, q).by_newton);
  EXPECT_LE(missed(q), 1e-10);
  EXPECT_LT(apart(forces_of(q), forces_of(p)), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Frictions, WheelWindow, testing::Values(0.0, 0.3, 1.0),
                         [](const auto& info) { return "Friction" + std::to_string(info.index); });

TEST(SolidWheel, GoesOnFromItsNumbersToTheSameBits) {
  const RollingBox rolling;
  SolidWheel wheel = rolling.wheel();
  wheel.start(rolling.motion(-1));
  for (int n = 0; n < 30; ++n) {
    const SolidWheelReport report = wheel.step(rolling.motion(n));
    ASSERT_LE(report.law_residual, 1e-6);
  }
  SolidWheel other = rolling.wheel();
  other.restore(wheel.save());
  for (int n = 30; n < 40; ++n) {
    const SolidWheelReport a = wheel.step(rolling.motion(n));
    const SolidWheelReport b = other.step(rolling.motion(n));
    ASSERT_GT(a.contacts.size(), 10U);
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
    for (std::size_t i = 0; i < a.contacts.size(); ++i)
      ASSERT_EQ(a.contacts[i].force, b.contacts[i].force) << n;
  }
}

}  // namespace cone_law_test
}  // namespace rondo::rom
