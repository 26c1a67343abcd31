// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/reduced_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <numbers>
#include <random>

#include "rondo/core/complex.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/mesh/disk.hpp"

namespace reduced_model_test {

using namespace rondo;
using namespace rondo::rom;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Body {
  mesh::Mesh mesh;
  std::vector<double> mass;
  fem::SectorStiffness stiffness;
};

Body body(int columns) {
  const fem::Material rubber{2.0e7, 0.3, 1100.0, fem::Plane::strain};
  mesh::Disk disk;
  disk.radial = 3;
  disk.circumferential = columns;
  Body b{mesh::make_disk(disk), {}, {}};
  b.mass = fem::lumped_mass(b.mesh, {&rubber, 1});
  b.stiffness = fem::assemble_sector(b.mesh, {&rubber, 1});
  return b;
}

/// Random fields, 0 on clamped nodes.
MatrixXd random_fields(const Body& b, Index columns, unsigned seed = 3) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const std::vector<char> clamped = mesh::clamped_flags(b.mesh);
  MatrixXd fields = MatrixXd::Zero(static_cast<Index>(2 * b.mesh.n_nodes()), columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < fields.rows(); ++i)
      if (!clamped[static_cast<std::size_t>(i / 2)]) fields(i, j) = normal(engine);
  return fields;
}

MatrixXd weighted(const Body& b, const MatrixXd& fields) {
  return mass_roots(b.mass).asDiagonal() * fields;
}

MatrixXd stiffness_times(const Body& b, const MatrixXd& fields) {
  MatrixXd out(fields.rows(), fields.cols());
  std::vector<Vec2> in(b.mesh.n_nodes()), made(b.mesh.n_nodes());
  for (Index j = 0; j < fields.cols(); ++j) {
    for (std::size_t i = 0; i < in.size(); ++i)
      in[i] = {fields(static_cast<Index>(2 * i), j), fields(static_cast<Index>(2 * i + 1), j)};
    fem::apply(b.stiffness, in, made);
    for (std::size_t i = 0; i < in.size(); ++i) {
      out(static_cast<Index>(2 * i), j) = made[i].x;
      out(static_cast<Index>(2 * i + 1), j) = made[i].y;
    }
  }
  return out;
}

ReducedModel reduced(const Body& b, const MatrixXd& basis, int stride = 1) {
  ReducedModel m = make_reduced_model(
      {b.mesh, b.mass,
       [&](std::span<const Vec2> in, std::span<Vec2> out) { fem::apply(b.stiffness, in, out); }},
      basis);
  set_contact(b.mesh, ContactForm::places, hat_weights(b.mesh.n_sectors, stride), m);
  return m;
}

/// T(θ) of fields, by way of lift() on a basis of themselves: T(-θ) there.
VectorXd turned(const Body& b, const MatrixXd& field, double theta) {
  ReducedModel only;
  only.basis = field;
  Lift lift(b.mesh, only);
  std::vector<Vec2> out(b.mesh.n_nodes());
  lift.lift(-theta, VectorXd::Ones(1), out);
  VectorXd numbers(field.rows());
  for (std::size_t i = 0; i < out.size(); ++i)
    numbers.segment(static_cast<Index>(2 * i), 2) << out[i].x, out[i].y;
  return numbers;
}

constexpr std::array sectors{24, 15};

TEST(Generator, IsTheDerivativeOfTheMove) {
  for (const int n : sectors) {
    const Body b = body(n);
    const MatrixXd field = random_fields(b, 1);
    const double h = 1e-4;  // error h²/6 of the third derivative, at most (N/2)³ of the field
    const VectorXd quotient = (turned(b, field, h) - turned(b, field, -h)) / (2.0 * h);
    const VectorXd found = differentiate(b.mesh, field);
    EXPECT_LT((found - quotient).norm(), h * h / 6.0 * std::pow(0.5 * n, 3) * field.norm());
    EXPECT_GT(found.norm(), field.norm());  // harmonics 2 and above are in it
  }
}

TEST(Generator, IsSkewInTheMassAndCommutesWithTheStiffness) {
  for (const int n : sectors) {
    const Body b = body(n);
    const MatrixXd fields = random_fields(b, 6);
    const MatrixXd w = weighted(b, fields), dw = weighted(b, differentiate(b.mesh, fields));
    const MatrixXd g = w.transpose() * dw;
    EXPECT_LT((g + g.transpose()).norm(), 1e-13 * g.norm());  // sums of some hundred products
    const MatrixXd kd = stiffness_times(b, differentiate(b.mesh, fields));
    const MatrixXd dk = differentiate(b.mesh, stiffness_times(b, fields));
    EXPECT_LT((kd - dk).norm(), 1e-13 * kd.norm());
  }
}

TEST(Join, KeepsTheSpanAndDropsWhatIsThere) {
  const Body b = body(15);
  const MatrixXd first = random_fields(b, 5, 1);
  MatrixXd second(first.rows(), 3);
  second << random_fields(b, 1, 2), first * VectorXd::LinSpaced(5, -1.0, 1.0),
      first.col(0) + 1e-6 * random_fields(b, 1, 4);
  const MatrixXd q = join(std::array{first, second});
  ASSERT_EQ(q.cols(), 7);  // the second column of `second` is in the span of the first part
  EXPECT_LT((q.transpose() * q - MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-15 * 10);
  for (const MatrixXd& part : {first, second})
    EXPECT_LT((part - q * (q.transpose() * part)).norm(), 1e-14 * part.norm());
}

TEST(ReducedModel, HoldsTheFullMatrices) {
  const Body b = body(24);
  const MatrixXd w = join(std::array{weighted(b, random_fields(b, 8))});
  const ReducedModel m = reduced(b, w);
  const VectorXd q = VectorXd::LinSpaced(8, -1.0, 2.0);
  const VectorXd field = m.basis * q, roots = mass_roots(b.mass);
  const VectorXd kf = stiffness_times(b, field);
  EXPECT_NEAR(q.dot(m.stiffness * q), field.dot(kf), 1e-13 * field.dot(kf));
  EXPECT_EQ(m.generator, (-m.generator.transpose()).eval());
  EXPECT_EQ(m.turn, (-m.turn.transpose()).eval());
  const VectorXd p = VectorXd::LinSpaced(8, 3.0, -1.0);
  const VectorXd other = m.basis * p;
  double turned = 0.0, places = 0.0, sideways = 0.0, shift = 0.0;
  for (std::size_t i = 0; i < b.mesh.n_nodes(); ++i) {
    const auto at = static_cast<Index>(2 * i);
    const Vec2 u{field[at], field[at + 1]}, v{other[at], other[at + 1]};
    const Vec2 x = b.mesh.coordinates[i];
    turned += b.mass[i] * dot(v, turn90(u));
    places += b.mass[i] * dot(u, x);
    sideways += b.mass[i] * dot(u, turn90(x));
    shift += b.mass[i] * u.y;
  }
  // Round-off of sums over the nodes, whose terms are of the size of the norms.
  const double size = 1e-14 * q.norm() * p.norm();
  EXPECT_NEAR(p.dot(m.turn * q), turned, size);
  EXPECT_NEAR(q.dot(m.reference), places, size);
  EXPECT_NEAR(q.dot(m.turned_reference), sideways, size);
  EXPECT_NEAR(q.dot(m.translation.col(1)), shift, size);
}

TEST(Lift, IsTakenBackByTheModes) {
  const Body b = body(24);
  const ReducedModel m = reduced(b, join(std::array{weighted(b, random_fields(b, 6))}));
  Lift lift(b.mesh, m);
  const VectorXd q = VectorXd::LinSpaced(6, 1.0, -2.0);
  std::vector<Vec2> field(b.mesh.n_nodes());
  for (const double theta : {0.0, 0.7, -31.4}) {
    lift.lift(theta, q, field);
    EXPECT_LT((lift.restrict_to_modes(theta, field, b.mass) - q).norm(), 1e-13 * q.norm());
  }
}

TEST(ContactRows, AreMeansOfTheNodes) {
  const Body b = body(24);
  const MatrixXd w = join(std::array{weighted(b, random_fields(b, 4))});
  const ReducedModel fine = reduced(b, w, 1), coarse = reduced(b, w, 3);
  ASSERT_EQ(fine.contact.points.size(), 24U);
  ASSERT_EQ(coarse.contact.points.size(), 8U);
  const Vec2 lowest = fine.contact.points[0];
  EXPECT_NEAR(lowest.x, 0.0, 1e-16);
  EXPECT_NEAR(lowest.y, -0.3, 1e-16);
  const VectorXd q = VectorXd::LinSpaced(4, 1.0, 2.0);
  const VectorXd at_nodes = fine.contact.rows * q, at_points = coarse.contact.rows * q;
  for (Index k = 0; k < 8; ++k) {
    double mean = 0.0, place = 0.0, weight = 0.0;
    for (int d = -2; d <= 2; ++d) {
      const Index node = (3 * k + d + 24) % 24;
      const double share = (3.0 - std::abs(d)) / 9.0;
      mean += share * at_nodes[2 * node + 1];
      place += share * fine.contact.points[static_cast<std::size_t>(node)].y;
      weight += share;
    }
    EXPECT_NEAR(weight, 1.0, 1e-15);
    EXPECT_NEAR(at_points[2 * k + 1], mean, 1e-14 * at_nodes.norm());
    EXPECT_NEAR(coarse.contact.points[static_cast<std::size_t>(k)].y, place, 1e-15);
    EXPECT_NEAR(coarse.contact.share[0], 3.0 * fine.contact.share[0], 1e-15);
  }
}

/// Points between the places of the nodes: where the nodes come by when the disk has turned by a
/// part of a sector, with the lifted field there.
TEST(ContactRows, BetweenTheNodesAreTheLiftedField) {
  constexpr int phases = 3;
  const Body b = body(15);
  const MatrixXd w = join(std::array{weighted(b, random_fields(b, 3))});
  ReducedModel m = reduced(b, w);
  const double share = m.contact.share[0];
  set_contact(b.mesh, ContactForm::places, between_weights(b.mesh.n_sectors, phases), m);
  ASSERT_EQ(m.contact.points.size(), 45U);
  EXPECT_NEAR(m.contact.share[1], share / phases, 1e-16);
  EXPECT_NEAR(m.weights(0, 1), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(m.weights(1, 1), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(m.weights(0, 44), 2.0 / 3.0, 1e-15);
  const VectorXd q = VectorXd::LinSpaced(3, 1.0, -2.0), at = m.contact.rows * q;
  const pod::Rings ring = pod::boundary_rings(b.mesh);
  Lift lift(b.mesh, m);
  std::vector<Vec2> field(b.mesh.n_nodes());
  for (int j = 0; j < phases; ++j) {
    const double phase = 2.0 * std::numbers::pi / b.mesh.n_sectors * j / phases;
    lift.lift(phase, q, field);
    for (std::size_t k = 0; k < ring.point.size(); ++k) {
      const auto node =
          static_cast<std::size_t>(b.mesh.boundary[static_cast<std::size_t>(ring.point[k])]);
      const std::size_t point = k * phases + static_cast<std::size_t>(j);
      const Vec2 u = rotation(phase) * field[node];
      EXPECT_NEAR(at[static_cast<Index>(2 * point)], u.x, 1e-13 * at.norm());
      EXPECT_NEAR(at[static_cast<Index>(2 * point + 1)], u.y, 1e-13 * at.norm());
      EXPECT_LT(norm(m.contact.points[point] - rotation(phase) * b.mesh.coordinates[node]), 1e-15);
    }
  }
}

/// The rows at a phase are those of the lifted field at the nodes, where these are then.
TEST(ContactRows, OfNodesAreTheLiftedField) {
  mesh::Disk treaded;
  treaded.radial = 2;
  treaded.tread = mesh::Tread{
      .pitches = 12, .depth = 0.02, .land_columns = 2, .groove_columns = 1, .layers = 2};
  for (const bool with_tread : {false, true}) {
    Body b = body(24);
    if (with_tread) {
      b.mesh = mesh::make_disk(treaded);
      const fem::Material rubber{2.0e7, 0.3, 1100.0, fem::Plane::strain};
      b.mass = fem::lumped_mass(b.mesh, {&rubber, 1});
      b.stiffness = fem::assemble_sector(b.mesh, {&rubber, 1});
    }
    const MatrixXd w = join(std::array{weighted(b, random_fields(b, 3))});
    const ReducedModel m = make_reduced_model(
        {b.mesh, b.mass,
         [&](std::span<const Vec2> in, std::span<Vec2> out) { fem::apply(b.stiffness, in, out); }},
        w);
    const pod::Rings rings = pod::boundary_rings(b.mesh);
    ASSERT_EQ(rings.n_rings() > 1, with_tread);
    const double sector = 2.0 * std::numbers::pi / b.mesh.n_sectors, phase = 0.3 * sector;
    const int whole = 6;  // even: the highest harmonic stays on the material, and turns its sign
    const ContactRows rows = NodeRows(b.mesh, m).at(phase);
    Lift lift(b.mesh, m);
    const VectorXd q = VectorXd::LinSpaced(3, 1.0, -2.0);
    const VectorXd moved = rows.rows * q;
    std::vector<Vec2> field(b.mesh.n_nodes());
    const double theta = phase + whole * sector;
    lift.lift(theta, q, field);
    for (std::size_t k = 0; k < rings.point.size(); ++k) {
      // The node that was `whole` sectors back when the disk had not turned.
      const int n = b.mesh.n_sectors, within = static_cast<int>(k) % n;
      const auto material =
          k - static_cast<std::size_t>(within) + static_cast<std::size_t>((within - whole + n) % n);
      const auto candidate = static_cast<std::size_t>(rings.point[material]);
      const auto node = static_cast<std::size_t>(b.mesh.boundary[candidate]);
      const Vec2 u = rotation(theta) * field[node];
      const Vec2 x = rotation(theta) * b.mesh.coordinates[node];
      const auto row = static_cast<Index>(2 * k);
      EXPECT_NEAR(moved[row], u.x, 1e-12 * moved.norm());
      EXPECT_NEAR(moved[row + 1], u.y, 1e-12 * moved.norm());
      EXPECT_NEAR(norm(rows.points[k] - x), 0.0, 1e-14);
    }
  }
}

}  // namespace

}  // namespace reduced_model_test
