// SPDX-License-Identifier: BSD-3-Clause
/// Contact nodes without mass: the ring against dense algebra, its contacts against the law and all
/// sets of contacts that there are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "rondo/integrators/general/body_frames.hpp"
#include "rondo/integrators/massless/ring_contact.hpp"
#include "support/models.hpp"

namespace rondo::dynamics::massless_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

std::size_t at(Index index) {
  return static_cast<std::size_t>(index);
}

/// A coarse disk pressed onto flat ground, turning.
test::Built pressed_disk(double friction, double depth = 0.02, int layers = 3) {
  test::DiskCase c = test::rolling_disk(layers, 48);
  c.motion.height = Table(0.3 - depth);
  test::Built b = test::build(c);
  test::add_ground(b, {}, {friction, 0.0});
  test::make_contact_massless(b);
  return b;
}

VectorXd flat(std::span<const Vec2> field) {
  VectorXd out(static_cast<Index>(2 * field.size()));
  for (std::size_t i = 0; i < field.size(); ++i)
    out.segment<2>(static_cast<Index>(2 * i)) << field[i].x, field[i].y;
  return out;
}

std::vector<int> all_nodes(const RingMatrix& ring) {
  std::vector<int> nodes(ring.nodes().begin(), ring.nodes().end());
  nodes.insert(nodes.end(), ring.neighbours().begin(), ring.neighbours().end());
  return nodes;
}

/// Some displacements and velocities, the same in every run of the tests.
struct Random {
  std::mt19937 generator{7};
  std::uniform_real_distribution<double> within{-1.0, 1.0};

  Vec2 vector(double size) { return {size * within(generator), size * within(generator)}; }
};

void fill(const Model& model, MasslessContact& ring, double place, double rate) {
  Random random;
  for (Vec2& u : ring.motion().place) u = random.vector(place);
  for (Vec2& v : ring.motion().rate) v = random.vector(rate);
  for (Vec2& v : ring.motion().before) v = random.vector(rate);
  static_cast<void>(model);
}

ContactStep step_at(const Model& model, long long n) {
  return BodyFrame(model, frame_step(model.motion, n, model.dt)).contact;
}

/// What the ring's equation (3.10) leaves, with the impulses found; all dense.
VectorXd ring_residual(const Model& model, const RingMatrix& matrix, MasslessContact& ring,
                       const ContactStep& step) {
  const Eigen::SparseMatrix<double> k = fem::free_matrix(model.stiffness, all_nodes(matrix));
  const auto nc = static_cast<Index>(2 * matrix.nodes().size());
  const RingMotion& motion = ring.motion();
  VectorXd u = flat(motion.place), v = VectorXd::Zero(u.size());
  v << flat(ring.velocity()), flat(motion.rate);
  u.head(nc) += model.dt * v.head(nc);
  VectorXd out = (MatrixXd(k) * (u + model.stiffness_damping * v)).head(nc);
  for (const RingContact& c : ring.next().contacts) {
    const Vec2 force = conj(step.rotation_next) * from_frame(c.normal, c.impulse) / model.dt;
    out.segment<2>(2 * c.node) -= Eigen::Vector2d(force.x, force.y);
  }
  return out;
}

Vec2 position_after(const Model& model, const RingMatrix& matrix, MasslessContact& ring,
                    const ContactStep& step, std::size_t i) {
  const Vec2 u = ring.motion().place[i] + model.dt * ring.velocity()[i];
  const Vec2 center = step.center + model.dt * step.center_rate;
  const auto node = static_cast<std::size_t>(matrix.nodes()[i]);
  return center + step.rotation_next * (model.reference[node] + u);
}

TEST(RingMatrix, IsThePartOfKThatItSays) {
  const test::Built b = pressed_disk(0.3);
  RingMatrix ring(b.model.stiffness, b.model.contact->nodes);
  ASSERT_TRUE(ring.is_positive_definite());
  EXPECT_EQ(ring.nodes().size(), 48u);
  EXPECT_EQ(ring.neighbours().size(), 48u);
  const MatrixXd k = fem::free_matrix(b.model.stiffness, all_nodes(ring));
  Random random;
  std::vector<Vec2> u(96), product(48), solved(48);
  for (Vec2& value : u) value = Vec2{5.0, -3.0} + random.vector(1e-3);
  ring.product(u, product);
  const VectorXd expected = (k * flat(u)).head(96);
  EXPECT_LT((flat(product) - expected).norm(), 1e-11 * k.norm() * flat(u).norm());
  for (Vec2& value : solved) value = random.vector(1.0);
  const VectorXd load = flat(solved);
  ring.solve(solved);
  EXPECT_LT((k.topLeftCorner(96, 96) * flat(solved) - load).norm(), 1e-13 * load.norm());
  const MatrixXd inverse = k.topLeftCorner(96, 96).inverse();
  for (const int j : {0, 5, 47, 5}) {
    const auto column = ring.inverse_column(j);
    for (int i = 0; i < 48; ++i)
      for (int e = 0; e < 4; ++e)
        ASSERT_NEAR(column[at(i)][at(e)], inverse(2 * i + e / 2, 2 * j + e % 2),
                    1e-13 * inverse.norm());
  }
}

/// A rigid translation leaves no round-off of its size: nothing is held near this ring.
TEST(RingMatrix, ATranslationIsNoLoad) {
  const test::Built b = pressed_disk(0.3);
  const RingMatrix ring(b.model.stiffness, b.model.contact->nodes);
  std::vector<Vec2> u(96, Vec2{5.1, -3.7}), product(48, Vec2{1, 1});
  ring.product(u, product);
  for (const Vec2 p : product) EXPECT_EQ(p, Vec2{});
}

TEST(RingMatrix, SeesAMechanism) {
  mesh::Mesh m;  // a triangle that hangs on one node alone
  m.coordinates = {{0, 0}, {1, 0}, {0.5, 1}};
  m.cells = {{0, 1, 2, -1}};
  const fem::Material material{2e7, 0.3, 1100.0, fem::Plane::strain};
  const fem::BlockCsr k = fem::assemble_stiffness(m, {&material, 1});
  EXPECT_FALSE(RingMatrix(k, std::vector<int>{0, 1}).is_positive_definite());
  EXPECT_TRUE(RingMatrix(k, std::vector<int>{0}).is_positive_definite());
}

class RingLaw : public testing::TestWithParam<double> {};

/// Steps in a row: forces of one predict the next.
TEST_P(RingLaw, HoldsAtEveryNode) {
  const double friction = GetParam();
  const test::Built b = pressed_disk(friction);
  const RingMatrix matrix(b.model.stiffness, b.model.contact->nodes);
  MasslessContact ring(b.model);
  fill(b.model, ring, 5e-4, 20.0);
  for (long long n = 0; n < 4; ++n) {
    const ContactStep step = step_at(b.model, n);
    ring.solve(step);
    ASSERT_GE(ring.next().contacts.size(), 4u);
    EXPECT_TRUE(ring.next().converged);
    double largest = 0.0;
    for (const RingContact& c : ring.next().contacts) largest = std::max(largest, c.impulse.x);
    const double force = largest / b.model.dt;
    EXPECT_LT(ring_residual(b.model, matrix, ring, step).lpNorm<Eigen::Infinity>(), 1e-10 * force);
    std::vector<char> touches(matrix.nodes().size(), 0);
    for (const RingContact& c : ring.next().contacts) {
      const auto i = static_cast<std::size_t>(c.node);
      touches[i] = 1;
      const Vec2 x = position_after(b.model, matrix, ring, step, i);
      const Vec2 arm =
          b.model.reference[static_cast<std::size_t>(matrix.nodes()[i])] + ring.motion().place[i];
      const Vec2 way = x - (step.center + step.rotation * arm);
      EXPECT_NEAR(c.gap, x.y, 1e-15);
      EXPECT_GE(x.y, -1e-14);
      EXPECT_LE(std::abs(c.impulse.x * x.y), 1e-14 * largest);
      EXPECT_GE(c.impulse.x, 0.0);
      EXPECT_LE(std::abs(c.impulse.y), friction * c.impulse.x * (1 + 1e-12) + 1e-300);
      const double along = to_frame(c.normal, way).y;
      if (c.status == contact::Status::stick) {
        EXPECT_NEAR(along, 0.0, 1e-14);
      }
      if (c.status == contact::Status::slip && friction > 0.0) {
        EXPECT_NEAR(std::abs(c.impulse.y), friction * c.impulse.x, 1e-12 * largest);
        EXPECT_LE(c.impulse.y * along, 0.0);
      }
    }
    for (std::size_t i = 0; i < touches.size(); ++i)
      if (touches[i] == 0) {
        EXPECT_GE(position_after(b.model, matrix, ring, step, i).y, -1e-14) << i;
      }
    for (std::size_t i = 0; i < touches.size(); ++i)
      ring.motion().place[i] += b.model.dt * ring.velocity()[i];
    ring.motion().before.assign(ring.velocity().begin(), ring.velocity().end());
  }
}

INSTANTIATE_TEST_SUITE_P(All, RingLaw, testing::Values(0.0, 0.3, 0.8),
                         [](const auto& p) { return fmt::format("mu{}", int(10 * p.param)); });

/// Without friction the contacts are the one set, of all that nodes near the ground can form,
/// with forces that push and gaps that are open. Dense and without the code under test.
TEST(RingLaw, IsTheOneSetOfContactsWithoutFriction) {
  const test::Built b = pressed_disk(0.0, 0.006);
  const RingMatrix matrix(b.model.stiffness, b.model.contact->nodes);
  MasslessContact ring(b.model);
  fill(b.model, ring, 1e-3, 5.0);
  const ContactStep step = step_at(b.model, 0);
  ring.solve(step);
  const double dt = b.model.dt, beta = b.model.stiffness_damping;
  const MatrixXd k = fem::free_matrix(b.model.stiffness, all_nodes(matrix));
  const Index nc = 96;
  const RingMotion& motion = ring.motion();
  VectorXd star = flat(motion.place);
  star.tail(nc) += beta * flat(motion.rate);
  const MatrixXd inverse = k.topLeftCorner(nc, nc).inverse() / (1.0 + beta / dt);
  const VectorXd free = -inverse * (k * star).head(nc);
  const auto height = [&](const VectorXd& change, int i) {
    const Vec2 u = motion.place[at(i)] + Vec2{change[2 * i], change[2 * i + 1]};
    return (step.center + dt * step.center_rate +
            step.rotation_next *
                (b.model.reference[static_cast<std::size_t>(matrix.nodes()[at(i)])] + u))
        .y;
  };
  std::vector<int> near;
  for (int i = 0; i < 48; ++i)
    if (height(free, i) < 0.01) near.push_back(i);
  ASSERT_GE(near.size(), 4u);
  ASSERT_LE(near.size(), 12u);
  const Vec2 up = conj(step.rotation_next) * Vec2{0.0, 1.0};
  int solutions = 0;
  VectorXd found;
  for (unsigned set = 0; set < (1U << near.size()); ++set) {
    std::vector<int> pressed;
    for (std::size_t a = 0; a < near.size(); ++a)
      if ((set >> a) & 1U) pressed.push_back(near[a]);
    const auto m = static_cast<Index>(pressed.size());
    MatrixXd normals = MatrixXd::Zero(nc, m);
    VectorXd gaps(m);
    for (Index a = 0; a < m; ++a) {
      normals.col(a).segment<2>(2 * pressed[at(a)]) << up.x, up.y;
      gaps[a] = height(free, pressed[at(a)]);
    }
    const VectorXd force =
        m > 0 ? VectorXd((normals.transpose() * inverse * normals).ldlt().solve(-gaps)) : gaps;
    if (m > 0 && force.minCoeff() < 0.0) continue;
    const VectorXd change = free + inverse * normals * force;
    bool open = true;
    for (int i = 0; i < 48; ++i) open = open && height(change, i) > -1e-12;
    if (!open) continue;
    ++solutions;
    found = change;
  }
  ASSERT_EQ(solutions, 1);
  EXPECT_LT((dt * flat(ring.velocity()) - found).lpNorm<Eigen::Infinity>(), 1e-14);
}

/// A node that neither touched nor touches where it is predicted joins where the contact of its
/// neighbours pushes it down, as it does in a flat layer.
TEST(MasslessContact, NodesThatTheSolutionPushesDownJoin) {
  int extensions = 0;
  for (double depth = 0.001; depth < 0.03; depth += 0.0005) {
    const test::Built b = pressed_disk(0.0, depth, 24);
    const RingMatrix matrix(b.model.stiffness, b.model.contact->nodes);
    MasslessContact ring(b.model);
    ring.solve(step_at(b.model, 0));  // the ring alone gives way, by all of the depth at once
    extensions += ring.next().extensions;
    for (std::size_t i = 0; i < 48; ++i)
      EXPECT_GE(position_after(b.model, matrix, ring, step_at(b.model, 0), i).y, -1e-14);
  }
  EXPECT_GT(extensions, 0);
}

TEST(MasslessContact, GoesOnToTheSameBits) {
  const test::Built b = pressed_disk(0.3);
  MasslessContact one(b.model), other(b.model);
  fill(b.model, one, 5e-4, 20.0);
  one.solve(step_at(b.model, 0));
  const std::vector<double> numbers = one.save();
  ASSERT_TRUE(MasslessContact::is_saved(numbers, 48));
  EXPECT_FALSE(MasslessContact::is_saved(numbers, 3));
  EXPECT_FALSE(MasslessContact::is_saved(std::span(numbers).first(numbers.size() - 1), 48));
  EXPECT_FALSE(MasslessContact::is_saved({}, 48));
  other.restore(numbers);
  EXPECT_EQ(other.save(), numbers);
  fill(b.model, other, 5e-4, 20.0);
  for (MasslessContact* ring : {&one, &other}) ring->solve(step_at(b.model, 1));
  EXPECT_EQ(one.save(), other.save());
  for (std::size_t i = 0; i < 48; ++i) EXPECT_EQ(one.velocity()[i], other.velocity()[i]);
}

}  // namespace
}  // namespace rondo::dynamics::massless_test
