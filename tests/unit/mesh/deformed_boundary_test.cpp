// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/deformed_boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "rondo/mesh/disk.hpp"
#include "rondo/mesh/solid/wheel.hpp"

namespace rondo::mesh::deformed_boundary_test {
namespace {

Disk disk() {
  return {.outer_radius = 0.3,
          .inner_radius = 0.15,
          .radial = 2,
          .circumferential = 24,
          .grading = 1.0,
          .tread = {}};
}

/// u = (G - 1) X of all nodes.
std::vector<Vec2> stretched(const Mesh& mesh, double x, double y) {
  std::vector<Vec2> u;
  for (const Vec2 p : mesh.coordinates) u.push_back({(x - 1.0) * p.x, (y - 1.0) * p.y});
  return u;
}

double sum_of_extents(const Mesh& mesh, FieldView u) {
  const DeformedBoundary boundary(mesh);
  double sum = 0.0;
  for (std::size_t k = 0; k < mesh.boundary.size(); ++k) sum += boundary.extent(k, u);
  return sum;
}

double undeformed(const Mesh& mesh) {
  return std::accumulate(mesh.tributary.begin(), mesh.tributary.end(), 0.0);
}

}  // namespace

TEST(DeformedBoundary, UndeformedItIsTheTributaryLengthToTheBit) {
  Disk treaded = disk();
  treaded.tread = Tread{.pitches = 12, .depth = 0.02, .land_columns = 2, .groove_columns = 1};
  treaded.tread->layers = 1;
  for (const Disk& d : {disk(), treaded}) {
    const Mesh mesh = make_disk(d);
    const DeformedBoundary boundary(mesh);
    const std::vector<Vec2> none(mesh.n_nodes());
    for (std::size_t k = 0; k < mesh.boundary.size(); ++k)
      EXPECT_EQ(boundary.extent(k, none), mesh.tributary[k]);
    EXPECT_NEAR(sum_of_extents(mesh, stretched(mesh, 1.5, 1.5)), 1.5 * undeformed(mesh), 1e-14);
  }
}

TEST(DeformedBoundary, ANodeHasHalfOfTheEdgesBesideIt) {
  const Mesh mesh = make_disk(disk());
  const DeformedBoundary boundary(mesh);
  std::vector<Vec2> u(mesh.n_nodes());
  const auto node = [&](std::size_t k) { return static_cast<std::size_t>(mesh.boundary[k]); };
  u[node(5)] = {0.01, -0.02};
  const auto place = [&](std::size_t k) { return mesh.coordinates[node(k)] + u[node(k)]; };
  EXPECT_NEAR(boundary.extent(5, u), 0.5 * (norm(place(5) - place(4)) + norm(place(6) - place(5))),
              1e-15);
  EXPECT_NEAR(boundary.extent(4, u), 0.5 * (norm(place(4) - place(3)) + norm(place(5) - place(4))),
              1e-15);
  EXPECT_EQ(boundary.extent(8, u), mesh.tributary[8]);
}

TEST(DeformedBoundary, EdgesToClampedNodesCount) {
  Mesh mesh;  // a line of three nodes, the first of which is clamped
  mesh.coordinates = {{0, 0}, {1, 0}, {2, 0}};
  mesh.clamped = {0};
  mesh.boundary = {1, 2};
  mesh.tributary = {1.0, 0.5};
  mesh.contact_edges = {{1, 2}};
  mesh.curves = {{"other", {{1, 2}}}, {"tread", {{0, 1}, {1, 2}}}};
  const std::vector<Vec2> u{{0, 0}, {0.5, 0}, {1.5, 0}};
  const DeformedBoundary boundary(mesh);
  EXPECT_DOUBLE_EQ(boundary.extent(0, u), 1.75);  // half of 1.5 and of 2
  EXPECT_DOUBLE_EQ(boundary.extent(1, u), 1.0);
}

TEST(DeformedBoundary, OfAWheelItIsTheShareOfTheDeformedFaces) {
  const Mesh mesh =
      make_wheel({.disk = disk(), .width = 0.1, .axial = 3, .crown_radius = 0.4, .grooves = {}});
  const std::vector<Vec2> plane = stretched(mesh, 1.25, 1.25);
  std::vector<Vec3> larger;
  for (std::size_t i = 0; i < plane.size(); ++i)
    larger.emplace_back(plane[i], 0.25 * mesh.axial[i]);
  const DeformedBoundary boundary(mesh);
  const std::vector<Vec3> still(mesh.n_nodes());
  for (std::size_t k = 0; k < mesh.boundary.size(); ++k)
    EXPECT_EQ(boundary.extent(k, still), mesh.tributary[k]);
  const double all = undeformed(mesh);
  EXPECT_NEAR(sum_of_extents(mesh, larger), 1.5625 * all, 1e-14);
}

/// Two nodes beside each other along the axle, of a wheel that is stretched, turned and leans.
TEST(DeformedBoundary, AFootprintHasHalfOfTheEdgesBesideItsNodes) {
  const Mesh mesh =
      make_wheel({.disk = disk(), .width = 0.09, .axial = 3, .crown_radius = {}, .grooves = {}});
  std::vector<Vec3> larger;
  const std::vector<Vec2> plane = stretched(mesh, 1.25, 1.25);
  for (std::size_t i = 0; i < plane.size(); ++i)
    larger.emplace_back(plane[i], 0.25 * mesh.axial[i]);
  const Complex turn = rotation(0.3);
  const double camber = -0.2;
  Footprint footprint(GroundFrame(camber), turn);
  EXPECT_EQ(footprint.length(), 0.0) << "nothing touches";
  const auto place = [&](std::size_t k) {
    return turn * mesh.coordinates[static_cast<std::size_t>(mesh.boundary[k])];
  };
  std::size_t lowest = 0;
  for (std::size_t k = 0; k < mesh.boundary.size(); ++k)
    if (place(k).y < place(lowest).y) lowest = k;
  const DeformedBoundary boundary(mesh);
  for (std::size_t k = 0; k < mesh.boundary.size(); ++k) {
    const double z = mesh.axial[static_cast<std::size_t>(mesh.boundary[k])];
    if (norm(place(k) - place(lowest)) < 1e-9 && z > 0.0) boundary.widen(k, larger, footprint);
  }
  const Complex edge = rotation(std::numbers::pi / 12.0);
  const Vec2 at = 1.25 * place(lowest), ahead = 0.5 * (at + edge * at),
             behind = 0.5 * (at + conj(edge) * at);
  EXPECT_NEAR(footprint.length(), std::abs(ahead.x - behind.x), 1e-14);
  // The nodes are at .015 and .045 m, half of an edge reaches to 0, before all are stretched.
  const double above = std::max(ahead.y, behind.y) - at.y;
  EXPECT_NEAR(footprint.width(), std::cos(camber) * 1.25 * 0.045 - std::sin(camber) * above, 1e-14);
}

}  // namespace rondo::mesh::deformed_boundary_test
