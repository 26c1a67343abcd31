// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/latin/latin.hpp"

#include <gtest/gtest.h>

#include <random>

#include "../../support/latin.hpp"

namespace latin_test {

using namespace rondo;

namespace {

constexpr double direction = 3.0e6;

statics::LatinPair random_pair(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 engine(3);
  std::normal_distribution<double> number;
  const auto any = [&](double scale) {
    Eigen::MatrixXd m(rows, columns);
    for (double& x : m.reshaped()) x = scale * number(engine);
    return m;
  };
  return {any(1e4), any(1e-2)};
}

}  // namespace

// The pair found obeys Signorini and Coulomb, and lies along the search direction.
TEST(Latin, LawsHoldAlongTheDirection) {
  constexpr double friction = 0.4;
  const statics::LatinPair elastic = random_pair(8, 30);
  statics::LatinPair lawful;
  statics::obey_laws(elastic, direction, friction, lawful);
  EXPECT_LE(((lawful.force - elastic.force) - direction * (lawful.place - elastic.place))
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
  const statics::LatinProblem p{1e-7 * Eigen::MatrixXd::Identity(8, 8), elastic.place, friction};
  EXPECT_LE(statics::history_residual(p, lawful), 1e-14);
  EXPECT_LE(statics::increment_residuals(p, lawful).maxCoeff(), 1e-14);
  EXPECT_GT(statics::history_residual(p, elastic), 0.1);
}

// One candidate pressed in and out again: the tangent remembers.
TEST(Latin, SlipIsThatOfTheIncrement) {
  statics::LatinPair elastic{Eigen::MatrixXd(2, 3), Eigen::MatrixXd::Zero(2, 3)}, lawful;
  elastic.force << 10.0, 10.0, 10.0, 6.0, 3.0, -6.0;
  statics::obey_laws(elastic, 2.0, 0.5, lawful);  // limit 5
  EXPECT_DOUBLE_EQ(lawful.force(1, 0), 5.0);
  EXPECT_DOUBLE_EQ(lawful.place(1, 0), -0.5);
  EXPECT_DOUBLE_EQ(lawful.force(1, 1), 2.0);  // sticks: 3 + 2 · (-0.5)
  EXPECT_DOUBLE_EQ(lawful.place(1, 1), -0.5);
  EXPECT_DOUBLE_EQ(lawful.force(1, 2), -5.0);
  EXPECT_DOUBLE_EQ(lawful.place(1, 2), 0.5);
}

TEST(Latin, DirectionIsBetweenTheStiffnesses) {
  const Eigen::Vector3d eigenvalues(1e-8, 4e-8, 4e-6);
  const Eigen::MatrixXd g = eigenvalues.asDiagonal();
  EXPECT_NEAR(statics::chosen_direction(g, false), 5e6, 1e-3);
  EXPECT_NEAR(statics::chosen_direction(g, true), 5e6 * 2.0 / 3.0, 1e-3);
}

TEST(Latin, ElasticityIsBalanced) {
  const test::LatinDisk disk(4, 60, 9);
  const statics::LatinProblem p = disk.problem(test::sliding(10, 0.01, 0.005), 0.3);
  statics::CondensedElasticity elasticity(p.compliance, direction);
  statics::Latin latin(p, elasticity, direction, 0.8);
  for (int k = 0; k < 3; ++k) static_cast<void>(latin.iterate());
  const statics::LatinPair& b = latin.balanced();
  EXPECT_LE((b.place - p.free - p.compliance * b.force).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Pgd, ModesAreOrthonormalAndSolveTheBody) {
  const test::LatinDisk disk(4, 60, 9);
  const statics::LatinProblem p = disk.problem(test::sliding(20, 0.01, 0.005), 0.3);
  const auto body = disk.stiffened(direction);
  statics::Pgd pgd(*body, disk.nodes(), {direction, 1e-3, 1.0});
  statics::Latin latin(p, pgd, direction, 0.8);
  for (int k = 0; k < 12; ++k) static_cast<void>(latin.iterate());
  EXPECT_GT(pgd.solves(), pgd.modes());  // some were downsized
  for (const statics::Fields& f : {pgd.separated(0.0).modes, pgd.basis()}) {
    const Eigen::MatrixXd work = f.contact.transpose() * f.load;
    EXPECT_LE((work - Eigen::MatrixXd::Identity(work.rows(), work.cols())).cwiseAbs().maxCoeff(),
              1e-9);
    const statics::Adopted seen =
        statics::adopt(disk.stiffness(), disk.nodes(), direction, f.field);
    EXPECT_LE(seen.foreign, 1e-9);
    EXPECT_LE((seen.fields.load - f.load).norm(), 1e-9 * f.load.norm());
    EXPECT_LE((seen.fields.contact - f.contact).norm(), 1e-12 * f.contact.norm());
  }
}

// The pair that is balanced is so to round-off, whatever the modes leave out.
TEST(Pgd, BalancedWithFewModes) {
  const test::LatinDisk disk(4, 60, 9);
  const statics::LatinProblem p = disk.problem(test::pressing(20, 0.01), 0.3);
  const auto body = disk.stiffened(direction);
  statics::Pgd pgd(*body, disk.nodes(), {direction, 0.1, 1.0});
  statics::Latin latin(p, pgd, direction, 0.8);
  for (int k = 0; k < 3; ++k) static_cast<void>(latin.iterate());
  const statics::LatinPair& b = latin.balanced();
  EXPECT_LE((b.place - p.free - p.compliance * b.force).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Pgd, FieldsOfAnotherDirectionAreAdopted) {
  const test::LatinDisk disk(4, 60, 9);
  const statics::LatinProblem p = disk.problem(test::pressing(20, 0.01), 0.3);
  const auto body = disk.stiffened(direction);
  statics::Pgd first(*body, disk.nodes(), {direction, 1e-3, 0.3});
  statics::Latin latin(p, first, direction, 0.8);
  for (int k = 0; k < 15; ++k) static_cast<void>(latin.iterate());

  const double other = 2.0 * direction;
  const auto stiffer = disk.stiffened(other);
  statics::Adopted adopted =
      statics::adopt(disk.stiffness(), disk.nodes(), other, first.basis().field);
  EXPECT_LE(adopted.foreign, 1e-9);
  EXPECT_EQ(statics::loaded_places(disk.stiffness(), disk.nodes(), adopted.fields.field).size(),
            disk.nodes().size());
  statics::Pgd second(*stiffer, disk.nodes(), {other, 1e-3, 0.3});
  second.begin_with(adopted.fields);
  statics::Latin again(p, second, other, 0.8);
  for (int k = 0; k < 15; ++k) static_cast<void>(again.iterate());
  EXPECT_LE(second.solves(), 1);
  EXPECT_GE(first.solves(), 10);
}

TEST(Pgd, FieldsOfAnotherBodyAreForeign) {
  const test::LatinDisk disk(4, 60, 9);
  Eigen::MatrixXd field =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * disk.stiffness().n_rows()), 1);
  field(field.rows() / 2, 0) = 1.0;
  EXPECT_GT(statics::adopt(disk.stiffness(), disk.nodes(), direction, field).foreign, 0.5);
}

}  // namespace latin_test
