// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/solid/wheel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "rondo/core/complex.hpp"
#include "rondo/fem/solid/hexahedron.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/mesh/gmsh_reader.hpp"
#include "rondo/mesh/solid/face.hpp"
#include "support/msh_files.hpp"

namespace wheel_test {

using namespace rondo;
using mesh::Mesh;
using mesh::Wheel;

namespace {

/// 3×4×90 between 0.15 and 0.30 m, 0.1 m wide.
Wheel box() {
  Wheel wheel;
  wheel.disk.radial = 3;
  wheel.disk.circumferential = 90;
  wheel.width = 0.1;
  return wheel;
}

Wheel treaded() {
  Wheel wheel = box();
  wheel.disk.tread = mesh::Tread{
      .pitches = 12, .depth = 0.02, .land_columns = 3, .groove_columns = 2, .layers = 2};
  return wheel;
}

fem::HexahedronCorners corners_of(const Mesh& m, const mesh::Hexahedron& h) {
  fem::HexahedronCorners x;
  for (std::size_t i = 0; i < 8; ++i) x[i] = mesh::place_of(m, h[i]);
  return x;
}

double volume(const Mesh& m) {
  double sum = 0.0;
  for (const mesh::Hexahedron& h : m.hexahedra)
    for (const double v : fem::hexahedron_volumes(corners_of(m, h))) sum += v;
  return sum;
}

double area(const Mesh& m, const mesh::Surface& surface) {
  double sum = 0.0;
  for (const mesh::Face& face : surface.faces)
    for (const Vec3 share : mesh::face_shares(mesh::face_corners(m, face))) sum += norm(share);
  return sum;
}

const mesh::Surface& surface(const Mesh& m, const std::string& name) {
  for (const mesh::Surface& s : m.surfaces)
    if (s.name == name) return s;
  ADD_FAILURE() << name;
  return m.surfaces.front();
}

/// Area of a ring of n trapezia between two radii, `columns` of them.
double ring_area(double ri, double ro, int columns, int n) {
  return 0.5 * columns * std::sin(2.0 * std::numbers::pi / n) * (ro * ro - ri * ri);
}

}  // namespace

TEST(Wheel, BoxHasTheVolumeOfItsPolygon) {
  const Mesh m = mesh::make_wheel(box());
  EXPECT_TRUE(m.is_solid());
  EXPECT_EQ(m.n_nodes(), 90U * 4 * 5);
  EXPECT_EQ(m.n_nodes(), mesh::n_wheel_nodes(box()));
  EXPECT_EQ(m.hexahedra.size(), 90U * 3 * 4);
  EXPECT_EQ(m.clamped.size(), 90U * 5);
  EXPECT_EQ(m.boundary.size(), 90U * 5);
  EXPECT_EQ(m.n_sectors, 90);
  EXPECT_NEAR(volume(m), 0.1 * ring_area(0.15, 0.30, 90, 90), 1e-14);
  for (const mesh::Hexahedron& h : m.hexahedra)
    EXPECT_GT(fem::smallest_jacobian(corners_of(m, h)), 0.0);
}

TEST(Wheel, SectorsRepeatByRotationFromStraightDown) {
  for (const Wheel& wheel : {box(), treaded()}) {
    const Mesh m = mesh::make_wheel(wheel);
    const auto n = m.n_nodes() / static_cast<std::size_t>(m.n_sectors);
    EXPECT_NEAR(m.coordinates[0].x, 0.0, 1e-15);
    EXPECT_NEAR(m.coordinates[0].y, -0.15, 1e-15);
    EXPECT_EQ(m.axial[0], -0.05);
    for (std::size_t i = 0; i < m.n_nodes(); ++i) {
      EXPECT_EQ(i, static_cast<std::size_t>(m.sector[i]) * n +
                       static_cast<std::size_t>(m.sector_node[i]));
      const auto first = static_cast<std::size_t>(m.sector_node[i]);
      const Vec2 turned =
          rotation(2.0 * std::numbers::pi * m.sector[i] / m.n_sectors) * m.coordinates[first];
      EXPECT_LT(norm(turned - m.coordinates[i]), 1e-15);
      EXPECT_EQ(m.axial[first], m.axial[i]);
    }
  }
}

/// The faces look outwards, and the whole surface is closed: its normals sum to nothing.
TEST(Wheel, SurfacesLookOutwards) {
  const Mesh m = mesh::make_wheel(box());
  Vec3 sum;
  double enclosed = 0.0;  // ∮ x·n dA = 3 V
  for (const mesh::Surface& s : m.surfaces)
    for (const mesh::Face& face : s.faces) {
      const auto x = mesh::face_corners(m, face);
      const auto share = mesh::face_shares(x);
      Vec3 normal, middle;
      for (std::size_t i = 0; i < 4; ++i) normal += share[i], middle += 0.25 * x[i];
      sum += normal;
      enclosed += dot(middle, normal);
    }
  EXPECT_LT(norm(sum), 1e-14);
  EXPECT_NEAR(enclosed, 3.0 * volume(m), 1e-14);
  const double chord = 2.0 * std::sin(std::numbers::pi / 90);
  EXPECT_NEAR(area(m, surface(m, "rim")), 90 * 0.15 * chord * 0.1, 1e-14);
  EXPECT_NEAR(area(m, surface(m, "tread")), 90 * 0.30 * chord * 0.1, 1e-14);
  EXPECT_NEAR(area(m, surface(m, "left")), ring_area(0.15, 0.30, 90, 90), 1e-14);
  EXPECT_NEAR(area(m, surface(m, "right")), ring_area(0.15, 0.30, 90, 90), 1e-14);
}

TEST(Wheel, TributariesSumToTheContactSurface) {
  const Mesh m = mesh::make_wheel(box());
  const double face = 2.0 * 0.30 * std::sin(std::numbers::pi / 90) * 0.025;
  EXPECT_NEAR(std::accumulate(m.tributary.begin(), m.tributary.end(), 0.0), 90 * 4 * face, 1e-15);
  EXPECT_NEAR(m.tributary[0], 0.5 * face, 1e-17);  // on a shoulder
  EXPECT_NEAR(m.tributary[1], face, 1e-17);
}

/// Each once, with the axle on its left; none across a groove, and none from or to what is held.
TEST(Wheel, EdgesAroundTheWheel) {
  for (const mesh::Wheel& wheel : {box(), treaded()}) {
    const Mesh m = mesh::make_wheel(wheel);
    const auto edges = mesh::rolling_edges(m, "tread");
    const std::size_t lines = static_cast<std::size_t>(wheel.axial) + 1;
    EXPECT_EQ(edges.size(), wheel.disk.tread ? 12 * 3 * lines : 90 * lines);
    for (const auto& [a, b] : edges) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      EXPECT_EQ(m.axial[i], m.axial[j]);
      EXPECT_GT(cross(m.coordinates[i], m.coordinates[j]), 0.0);
    }
    const double columns = wheel.disk.tread ? 60 : 90;
    EXPECT_NEAR(mesh::longest_edge(m.coordinates, edges),
                0.60 * std::sin(std::numbers::pi / columns), 1e-15);
  }
}

TEST(Wheel, TreadHasLandsAndGroovesAcross) {
  const Mesh m = mesh::make_wheel(treaded());
  EXPECT_EQ(m.n_nodes(), 12U * 5 * (5 * 4 + 4 * 2));
  EXPECT_EQ(m.n_nodes(), mesh::n_wheel_nodes(treaded()));
  EXPECT_EQ(m.hexahedra.size(), 12U * 4 * (5 * 3 + 3 * 2));
  EXPECT_EQ(m.boundary.size(), 12U * 4 * 5);
  EXPECT_NEAR(volume(m), 0.1 * (ring_area(0.15, 0.28, 60, 60) + ring_area(0.28, 0.30, 36, 60)),
              1e-15);
  EXPECT_NEAR(std::accumulate(m.tributary.begin(), m.tributary.end(), 0.0),
              36 * 0.1 * 2.0 * 0.30 * std::sin(std::numbers::pi / 60), 1e-15);
  EXPECT_NEAR(area(m, surface(m, "tread")), 36 * 0.1 * 0.60 * std::sin(std::numbers::pi / 60),
              1e-15);
}

/// The top is the surface of revolution, and the depth of the tread is that of its middle.
TEST(Wheel, CrownDropsTowardsTheShoulders) {
  Wheel wheel = treaded();
  wheel.axial = 6;
  wheel.crown_radius = 0.2;
  const Mesh m = mesh::make_wheel(wheel);
  for (const int node : m.boundary) {
    const Vec3 x = mesh::place_of(m, node);
    EXPECT_NEAR(norm(x.plane()), 0.30 - (0.2 - std::sqrt(0.04 - x.z * x.z)), 1e-15);
  }
  const Mesh section = mesh::make_section(wheel);
  for (std::size_t j = 0; j < 7; ++j) {
    const auto r = [&](std::size_t layer) { return section.coordinates[7 * layer + j].x; };
    EXPECT_NEAR(r(5) - r(3), 0.02, 1e-15);
    EXPECT_EQ(r(0), 0.15);
    EXPECT_NEAR(r(2) - r(1), r(1) - r(0), 1e-15);  // evenly below
    EXPECT_EQ(r(5), section.coordinates[7 * 5 + 6 - j].x);
  }
  for (const mesh::Hexahedron& h : m.hexahedra)
    EXPECT_GT(fem::smallest_jacobian(corners_of(m, h)), 0.0);
}

/// One column a pitch, no grooves across: the sector is its own mirror image.
TEST(Wheel, GroovesAroundTheWheel) {
  Wheel wheel = box();
  wheel.axial = 7;
  wheel.disk.tread = mesh::Tread{
      .pitches = 24, .depth = 0.02, .land_columns = 1, .groove_columns = 0, .layers = 2};
  wheel.grooves = {{{-0.02, 0.01}}, {{0.02, 0.01}}};
  EXPECT_EQ(mesh::least_axial(wheel), 5);
  const std::vector<double> z = mesh::axial_lines(wheel),
                            expected{-0.05, -0.025, -0.015, -0.005, 0.005, 0.015, 0.025, 0.05};
  ASSERT_EQ(z.size(), expected.size());
  for (std::size_t j = 0; j < z.size(); ++j) EXPECT_NEAR(z[j], expected[j], 1e-16);
  const Mesh m = mesh::make_wheel(wheel);
  EXPECT_EQ(m.n_nodes(), 24U * 8 * 6);  // no line of nodes lies inside a groove
  EXPECT_EQ(m.n_nodes(), mesh::n_wheel_nodes(wheel));
  EXPECT_EQ(m.hexahedra.size(), 24U * (7 * 3 + 5 * 2));
  EXPECT_EQ(m.boundary.size(), 24U * 8);
  EXPECT_NEAR(volume(m), 0.1 * ring_area(0.15, 0.28, 24, 24) + 0.08 * ring_area(0.28, 0.30, 24, 24),
              1e-14);
  EXPECT_NEAR(area(m, surface(m, "tread")), 24 * 0.08 * 0.60 * std::sin(std::numbers::pi / 24),
              1e-14);
}

/// However many elements there are.
TEST(Wheel, LinesBetweenMirroredGroovesAreMirrored) {
  Wheel wheel = box();
  wheel.disk.tread = mesh::Tread{};
  wheel.grooves = {{{-0.02, 0.01}}, {{0.02, 0.01}}};
  for (wheel.axial = 5; wheel.axial < 20; ++wheel.axial) {
    const std::vector<double> z = mesh::axial_lines(wheel);
    ASSERT_EQ(z.size(), static_cast<std::size_t>(wheel.axial) + 1);
    for (std::size_t j = 0; j < z.size(); ++j)
      EXPECT_NEAR(z[j], -z[z.size() - 1 - j], 1e-17) << wheel.axial;
  }
}

TEST(Wheel, SharesOfAFaceHaveItsAreaAndItsMiddle) {
  const std::array<Vec3, 4> x{{{0, 0, 5}, {3, 0, 5}, {2, 2, 5}, {0, 1, 5}}};
  const std::array<Vec3, 4> share = mesh::face_shares(x);
  Vec3 area, middle;
  for (std::size_t i = 0; i < 4; ++i) {
    area += share[i];
    middle += share[i].z * x[i];
  }
  EXPECT_LT(norm(area - Vec3{0, 0, 4}), 1e-14);
  EXPECT_LT(norm(0.25 * middle - Vec3{17.0 / 12.0, 0.75, 5}), 1e-14);
}

TEST(Wheel, WideGroovesLoseTheirNodes) {
  Wheel wheel = box();
  wheel.axial = 10;
  wheel.disk.tread = mesh::Tread{
      .pitches = 24, .depth = 0.02, .land_columns = 2, .groove_columns = 1, .layers = 2};
  wheel.grooves = {{{-0.04, 0.02}}, {{0.01, 0.04}}};  // the first takes the shoulder away
  EXPECT_EQ(mesh::least_axial(wheel), 4);
  const Mesh m = mesh::make_wheel(wheel);
  EXPECT_LT(m.n_nodes(), mesh::n_wheel_nodes(wheel));
  EXPECT_NEAR(volume(m), 0.1 * ring_area(0.15, 0.28, 72, 72) + 0.04 * ring_area(0.28, 0.30, 48, 72),
              1e-14);
  EXPECT_NEAR(std::accumulate(m.tributary.begin(), m.tributary.end(), 0.0),
              48 * 0.04 * 0.60 * std::sin(std::numbers::pi / 72), 1e-14);
  std::vector<char> used(m.n_nodes(), 0);
  for (const mesh::Hexahedron& h : m.hexahedra)
    for (const int node : h) used[static_cast<std::size_t>(node)] = 1;
  EXPECT_EQ(std::accumulate(used.begin(), used.end(), std::size_t{0}), m.n_nodes());
  for (const int node : m.boundary) {
    const Vec3 x = mesh::place_of(m, node);
    EXPECT_NEAR(norm(x.plane()), 0.30, 1e-15);
    EXPECT_TRUE((x.z > -0.0301 && x.z < -0.0099) || x.z > 0.0299) << x.z;
  }
}

/// The case of a wheel that is drawn: two surfaces, and a cavity beside them.
TEST(Wheel, SectionFromAFile) {
  test::Msh msh;
  msh.names = {"1 1 \"rim\"",     "1 2 \"tread\"",   "1 3 \"cavity\"",
               "1 7 \"between\"", "2 4 \"carcass\"", "2 5 \"rubber\""};
  for (const char* z : {"-1", "0", "2"})
    for (const char* r : {"3", "4", "6"}) msh.nodes.push_back(fmt::format("{} {} 0", r, z));
  msh.elements = {"1 2 1 1 1 4",     "1 2 1 1 4 7",     "1 2 2 2 3 6",     "1 2 2 2 6 9",  //
                  "1 2 3 3 8 7",     "1 2 3 3 9 8",     "1 2 7 7 2 5",     "1 2 7 7 5 8",
                  "3 2 4 1 1 2 5 4", "3 2 4 1 4 5 8 7", "3 2 5 2 2 3 6 5", "3 2 5 2 5 6 9 8"};
  const test::TemporaryFile file(msh.text());
  const mesh::MeshRequest request{.file = file.path(),
                                  .scale = 0.1,
                                  .clamped = {"rim"},
                                  .contact = "tread",
                                  .curves = {"cavity"}};
  const Mesh section = mesh::read_gmsh(request).mesh;
  const Mesh m = mesh::revolve(section, {20, 1, {}}, "tread");
  EXPECT_EQ(m.n_nodes(), 180U);
  EXPECT_EQ(m.clamped.size(), 60U);
  EXPECT_EQ(m.boundary.size(), 60U);
  EXPECT_EQ(m.region_names, (std::vector<std::string>{"carcass", "rubber"}));
  double of_region[2] = {0.0, 0.0};
  for (std::size_t e = 0; e < m.hexahedra.size(); ++e) {
    EXPECT_GT(fem::smallest_jacobian(corners_of(m, m.hexahedra[e])), 0.0);
    for (const double v : fem::hexahedron_volumes(corners_of(m, m.hexahedra[e])))
      of_region[m.region[e]] += v;
  }
  EXPECT_NEAR(of_region[0], 0.3 * ring_area(0.3, 0.4, 20, 20), 1e-14);
  EXPECT_NEAR(of_region[1], 0.3 * ring_area(0.4, 0.6, 20, 20), 1e-14);
  EXPECT_NEAR(area(m, surface(m, "cavity")), ring_area(0.3, 0.6, 20, 20), 1e-14);
  EXPECT_EQ(m.surfaces.size(), 3U);  // what lies between two cells is none
  for (const mesh::Face& face : surface(m, "cavity").faces)
    for (const Vec3 share : mesh::face_shares(mesh::face_corners(m, face)))
      EXPECT_GT(share.z, 0.0);  // at z = 0.2: outwards
  EXPECT_NEAR(std::accumulate(m.tributary.begin(), m.tributary.end(), 0.0),
              area(m, surface(m, "tread")), 1e-14);
}

/// A contact curve that goes down both sides to the rim: what stands beside a held node is half of
/// the last face's, as in the plane, and the held ones are no candidates.
TEST(Wheel, ContactCurveThatEndsAtTheRim) {
  Mesh section = mesh::make_section(box());
  mesh::Curve all{"all", {}};
  for (const mesh::Curve& curve : section.curves)
    if (curve.name != "rim")
      all.edges.insert(all.edges.end(), curve.edges.begin(), curve.edges.end());
  section.curves.push_back(all);
  const Mesh m = mesh::revolve(section, {20, 1, {}}, "all");
  EXPECT_EQ(m.boundary.size(), 20U * (5 + 2 * 2));  // of the top, and two layers on each side
  double held = 0.0;
  const std::vector<char> clamped = mesh::clamped_flags(m);
  for (const mesh::Face& face : surface(m, "all").faces) {
    const auto share = mesh::face_shares(mesh::face_corners(m, face));
    for (std::size_t i = 0; i < 4; ++i)
      if (clamped[static_cast<std::size_t>(face[i])]) held += norm(share[i]);
  }
  EXPECT_GT(held, 0.4 * 2 * ring_area(0.15, 0.20, 20, 20));
  EXPECT_LT(held, 0.5 * 2 * ring_area(0.15, 0.20, 20, 20));  // the inner half is the smaller
  EXPECT_NEAR(std::accumulate(m.tributary.begin(), m.tributary.end(), 0.0) + held,
              area(m, surface(m, "all")), 1e-14);
}

TEST(Wheel, TrianglesAndTheAxleAreNoSections) {
  Mesh section = mesh::make_section(box());
  section.cells[3][3] = -1;
  EXPECT_DEATH(mesh::revolve(section, {20, 1, {}}, "tread"), "n_corners");
  section = mesh::make_section(box());
  section.coordinates[0].x = 0.0;
  EXPECT_DEATH(mesh::revolve(section, {20, 1, {}}, "tread"), "r > 0");
}

}  // namespace wheel_test
