// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/contact_mass.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "rondo/fem/assembly.hpp"
#include "rondo/mesh/disk.hpp"

namespace rondo::fem::contact_mass_test {
namespace {

const Material rubber{2.0e7, 0.3, 1100.0, Plane::strain};

mesh::Mesh disk(bool tread) {
  mesh::Disk d{.outer_radius = 0.3,
               .inner_radius = 0.2,
               .radial = 3,
               .circumferential = 16,
               .grading = 1.0,
               .tread = {}};
  if (tread) d.tread = mesh::Tread{8, 0.02, 2, 1, 2};
  return mesh::make_disk(d);
}

/// Two rows of triangles over the contact boundary y = 0, above each other; nothing is held.
mesh::Mesh triangles() {
  mesh::Mesh m;
  m.coordinates = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  m.cells = {{0, 1, 4, -1}, {0, 4, 3, -1}, {1, 2, 5, -1}, {1, 5, 4, -1}};
  m.boundary = {0, 1, 2};
  return m;
}

double sum(const std::vector<double>& mass) {
  return std::accumulate(mass.begin(), mass.end(), 0.0);
}

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

TEST(ContactMass, GoesToTheNodeBelowOnADisk) {
  for (const bool tread : {false, true}) {
    const mesh::Mesh m = disk(tread);
    const std::vector<double> lumped = lumped_mass(m, {&rubber, 1});
    const MovedMass moved = move_contact_mass(m, lumped, m.boundary);
    ASSERT_EQ(moved.without_neighbour, -1);
    EXPECT_NEAR(sum(moved.mass), sum(lumped), 1e-13 * sum(lumped));
    for (const int node : m.boundary) {
      EXPECT_EQ(moved.mass[at(node)], 0.0);
      // Straight towards the axis: the nearest of all other nodes in that direction.
      const Vec2 x = m.coordinates[at(node)];
      std::size_t below = 0;
      for (std::size_t k = 0; k < m.n_nodes(); ++k) {
        const Vec2 y = m.coordinates[k];
        const bool inside =
            std::abs(cross(x, y)) < 1e-9 && dot(x, y) > 0.0 && norm(y) < norm(x) - 1e-6;
        if (inside && norm(y) > norm(m.coordinates[below])) below = k;
        if (inside && norm(m.coordinates[below]) > norm(x) - 1e-6) below = k;
      }
      EXPECT_DOUBLE_EQ(moved.mass[below], lumped[below] + lumped[at(node)]) << node;
    }
  }
}

TEST(ContactMass, IsSharedOutWhereThereAreSeveralNodesBelow) {
  const mesh::Mesh m = triangles();
  const std::vector<double> lumped{1, 2, 4, 8, 16, 32};
  // 0 has edges to 3 and 4, 1 to 4 and 5, 2 to 5.
  const MovedMass moved = move_contact_mass(m, lumped, m.boundary);
  EXPECT_EQ(moved.mass, (std::vector<double>{0, 0, 0, 8.5, 16 + 0.5 + 1, 32 + 1 + 4}));
}

TEST(ContactMass, GoesAcrossACellWhereNoEdgeLeadsToMass) {
  mesh::Mesh m;  // a quadrilateral whose corner at the origin has contact nodes on either side
  m.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  m.cells = {{0, 1, 2, 3}};
  m.boundary = {3, 0, 1};
  const MovedMass moved = move_contact_mass(m, std::vector<double>{1, 1, 1, 1}, m.boundary);
  EXPECT_EQ(moved.mass, (std::vector<double>{0, 0, 4, 0}));
}

TEST(ContactMass, ANodeThatNothingTakesTheMassOfIsNamed) {
  mesh::Mesh m = triangles();
  m.clamped = {3, 4, 5};
  EXPECT_EQ(move_contact_mass(m, std::vector<double>(6, 1.0), m.boundary).without_neighbour, 0);
  m.clamped = {5};  // beside 2 there is nothing else
  EXPECT_EQ(move_contact_mass(m, std::vector<double>(6, 1.0), m.boundary).without_neighbour, 2);
}

TEST(ContactMass, KeepsCenterAndInertia) {
  const mesh::Mesh m = disk(true);
  const std::vector<int> free = free_nodes(m);
  const std::vector<double> lumped = lumped_mass(m, {&rubber, 1});
  std::vector<double> kept = move_contact_mass(m, lumped, m.boundary).mass;
  const std::vector<double> moved = kept;
  ASSERT_TRUE(keep_moments(m, lumped, free, kept));
  const auto moments = [&](const std::vector<double>& mass) {
    std::array<double, 4> of{};
    for (const int node : free) {
      const Vec2 x = m.coordinates[at(node)];
      const double terms[] = {1.0, x.x, x.y, dot(x, x)};
      for (std::size_t t = 0; t < 4; ++t) of[t] += mass[at(node)] * terms[t];
    }
    return of;
  };
  const auto before = moments(lumped), after = moments(kept);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_NEAR(after[t], before[t], 1e-13 * before[0]) << t;
  EXPECT_LT(moments(moved)[3], 0.999 * before[3]);  // what there was to be made good
  for (const int node : free) EXPECT_EQ(kept[at(node)] > 0.0, moved[at(node)] > 0.0) << node;
}

TEST(ContactMass, RefusesMomentsThatNoPositiveMassesHave) {
  mesh::Mesh m;  // one node with mass cannot have the inertia of two
  m.coordinates = {{1, 0}, {2, 0}};
  std::vector<double> mass{2, 0};
  EXPECT_FALSE(keep_moments(m, std::vector<double>{1, 1}, std::vector<int>{0, 1}, mass));
  EXPECT_EQ(mass, (std::vector<double>{2, 0}));
}

}  // namespace
}  // namespace rondo::fem::contact_mass_test
