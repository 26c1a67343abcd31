// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/tangent_factors.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

namespace tangent_factors_test {
namespace {

using rondo::Vec3;
using rondo::statics::TangentFactors;

constexpr std::size_t nodes = 12;

/// Springs between nodes in a row, of which some also reach the next but one. The first node is
/// held.
struct Chain {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes);
  std::vector<char> moves = std::vector<char>(nodes, 1);

  Chain() {
    moves[0] = 0;
    for (std::size_t a = 0; a + 1 < nodes; ++a)
      spring(a, a + 1, 1.0 + 0.1 * static_cast<double>(a));
    for (std::size_t a = 0; a + 2 < nodes; a += 3) spring(a, a + 2, 0.7);
  }
  void spring(std::size_t a, std::size_t b, double stiffness) {
    Eigen::Matrix3d k;
    k << 3.0, 1.0, 0.0, 1.0, 2.0, 0.5, 0.0, 0.5, 4.0;
    k *= stiffness;
    const auto i = static_cast<Eigen::Index>(3 * a), j = static_cast<Eigen::Index>(3 * b);
    matrix.block<3, 3>(i, i) += k;
    matrix.block<3, 3>(j, j) += k;
    matrix.block<3, 3>(i, j) -= k;
    matrix.block<3, 3>(j, i) -= k;
  }
  void give(TangentFactors& to) const {
    for (std::size_t a = 0; a < nodes; ++a)
      for (std::size_t b = 0; b < nodes; ++b)
        to.take(
            a, b,
            matrix.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)));
  }
  /// The compliance of what moves, (3 (n - 1), 3 (n - 1)).
  [[nodiscard]] Eigen::MatrixXd inverse() const {
    return matrix.bottomRightCorner(3 * nodes - 3, 3 * nodes - 3).inverse();
  }
};

const std::vector<std::size_t> touching{7, 2, 11};

}  // namespace

TEST(TangentFactors, MovesWhatIsNotHeld) {
  const Chain chain;
  TangentFactors k(chain.moves, touching);
  chain.give(k);
  ASSERT_TRUE(k.factor());
  std::vector<Vec3> force(nodes), u(nodes, Vec3{1.0, 2.0, 3.0});
  Eigen::VectorXd right(3 * nodes);
  for (std::size_t a = 0; a < nodes; ++a) {
    force[a] = {1.0, 0.1 * static_cast<double>(a), -2.0};
    right.segment<3>(static_cast<Eigen::Index>(3 * a)) << force[a].x, force[a].y, force[a].z;
  }
  k.move(force, u);
  const Eigen::VectorXd moved = chain.inverse() * right.tail(3 * nodes - 3);
  EXPECT_EQ(u[0].x, 1.0);
  for (std::size_t a = 1; a < nodes; ++a) {
    const auto of = moved.segment<3>(static_cast<Eigen::Index>(3 * a - 3));
    EXPECT_NEAR(u[a].x - 1.0, of[0], 1e-11);
    EXPECT_NEAR(u[a].y - 2.0, of[1], 1e-11);
    EXPECT_NEAR(u[a].z - 3.0, of[2], 1e-11);
  }
}

TEST(TangentFactors, TheComplianceIsABlockOfTheInverse) {
  const Chain chain;
  TangentFactors k(chain.moves, touching);
  chain.give(k);
  ASSERT_TRUE(k.factor());
  const Eigen::MatrixXd found = k.compliance(), all = chain.inverse();
  ASSERT_EQ(found.rows(), 9);
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = 0; b < 3; ++b) {
      const auto row = static_cast<Eigen::Index>(3 * touching[static_cast<std::size_t>(a)] - 3),
                 column = static_cast<Eigen::Index>(3 * touching[static_cast<std::size_t>(b)] - 3);
      EXPECT_LT((found.block<3, 3>(3 * a, 3 * b) - all.block<3, 3>(row, column)).norm(),
                1e-12 * all.norm());
    }
}

TEST(TangentFactors, AnOrderServesOtherTouchingNodes) {
  const Chain chain;
  TangentFactors first(chain.moves, touching);
  chain.give(first);
  ASSERT_TRUE(first.factor());
  const std::vector<std::size_t> one{5};
  TangentFactors second(chain.moves, one, first.order());
  chain.give(second);
  ASSERT_TRUE(second.factor());
  EXPECT_EQ(second.order(), first.order());
  EXPECT_LT((second.compliance() - chain.inverse().block<3, 3>(12, 12)).norm(), 1e-12);
}

/// In a row with its springs to the next but one, some touching nodes have no neighbours but such.
TEST(TangentFactors, TouchingNodesMayHaveTouchingNeighboursAlone) {
  const Chain chain;
  const std::vector<std::size_t> all{11, 1, 10, 3, 9, 2, 4, 8, 5};
  TangentFactors k(chain.moves, all);
  chain.give(k);
  ASSERT_TRUE(k.factor());
  const Eigen::MatrixXd found = k.compliance(), inverse = chain.inverse();
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b) {
      const auto row = static_cast<Eigen::Index>(3 * a), column = static_cast<Eigen::Index>(3 * b);
      EXPECT_LT((found.block<3, 3>(row, column) -
                 inverse.block<3, 3>(static_cast<Eigen::Index>(3 * all[a] - 3),
                                     static_cast<Eigen::Index>(3 * all[b] - 3)))
                    .norm(),
                1e-12 * inverse.norm());
    }
}

TEST(TangentFactors, TellsWhatIsNotPositiveDefinite) {
  const std::vector<char> moves{1};
  TangentFactors k(moves, {});
  k.take(0, 0, Eigen::Vector3d(1.0, -1.0, 1.0).asDiagonal());
  EXPECT_FALSE(k.factor());
}

}  // namespace tangent_factors_test
