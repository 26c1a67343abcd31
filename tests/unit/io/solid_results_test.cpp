// SPDX-License-Identifier: BSD-3-Clause
/// Results of a wheel in three dimensions: its mesh comes back, and places, vectors and stresses
/// along the fixed axes are those of plain matrices.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "rondo/io/mesh_files.hpp"
#include "rondo/io/results.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "unit/io/support.hpp"

namespace rondo::io::test::solid_results_test {
namespace {

constexpr double camber = 0.2, angle = 0.7, lateral = 0.3;
constexpr Vec2 center{2.0, 0.29};

mesh::Mesh wheel() {
  mesh::Wheel w;
  w.disk.outer_radius = 0.3;
  w.disk.inner_radius = 0.15;
  w.disk.radial = 1;
  w.disk.circumferential = 5;
  w.width = 0.1;
  w.axial = 2;
  return mesh::make_wheel(w);
}

/// Values that depend on the node.
struct SolidRun {
  mesh::Mesh mesh = wheel();
  std::vector<double> mass = std::vector<double>(mesh.n_nodes(), 0.25);
  std::vector<Vec3> u, force, fixed;
  std::vector<fem::SolidStress> stress;

  SolidRun() {
    const auto of = [](std::size_t i, std::size_t period) {
      const auto number = [&](std::size_t c) { return static_cast<double>((3 * i + c) % period); };
      return Vec3{number(0), number(1), number(2)};
    };
    for (std::size_t i = 0; i < mesh.n_nodes(); ++i)
      u.push_back(1e-3 * of(i, 17) - Vec3{5e-3, 5e-3, 5e-3});
    for (std::size_t k = 0; k < mesh.boundary.size(); ++k) {
      force.push_back(of(k, 7));
      fixed.push_back(of(k, 5));
    }
    for (std::size_t i = 0; i < mesh.n_nodes(); ++i) {
      const auto s = static_cast<double>(i);
      stress.push_back({s, 2.0 - s, 3.0, -s, 0.5 * s, 1.0 + s});
    }
  }

  [[nodiscard]] ResultsLayout layout() const {
    ResultsLayout l;
    l.mesh = &mesh;
    l.mass = mass;
    l.n_snapshots = 1;
    l.contact = l.stress = true;
    l.components = 3;
    l.camber = camber;
    return l;
  }

  [[nodiscard]] Snapshot snapshot() const {
    Snapshot s;
    s.angle = s.angle_velocity = angle;
    s.center = {center, lateral};
    s.u = s.v = u;
    return s;
  }
  [[nodiscard]] SnapshotFields fields() const {
    return {.contact_force = force, .contact_force_fixed = fixed, .solid_stress = stress};
  }

  [[nodiscard]] Eigen::Vector3d u_of(std::size_t i) const { return {u[i].x, u[i].y, u[i].z}; }
  [[nodiscard]] Eigen::Vector3d place_of(std::size_t i) const {
    return {mesh.coordinates[i].x, mesh.coordinates[i].y, mesh.axial[i]};
  }
};

void write(const Folder& folder, const SolidRun& run) {
  Results results(folder.path(), run.layout());
  results.write(run.snapshot(), run.fields());
  results.close();
}

TEST(SolidResults, MeshComesBack) {
  const Folder folder;
  const SolidRun run;
  write(folder, run);
  const MeshWithMass read = read_mesh(h5::File::open(folder / "results.h5"));
  EXPECT_EQ(read.mesh.coordinates, run.mesh.coordinates);
  EXPECT_EQ(read.mesh.axial, run.mesh.axial);
  EXPECT_EQ(read.mesh.hexahedra, run.mesh.hexahedra);
  EXPECT_TRUE(read.mesh.cells.empty());
  EXPECT_EQ(read.mesh.boundary, run.mesh.boundary);
  EXPECT_EQ(read.mesh.n_sectors, 5);
  EXPECT_EQ(read.mass, run.mass);
}

TEST(SolidResults, HashSeesTheAxleAndTheHexahedra) {
  const mesh::Mesh mesh = wheel();
  mesh::Mesh moved = mesh, turned = mesh;
  moved.axial[3] += 1e-16;
  std::swap(turned.hexahedra[0], turned.hexahedra[1]);
  EXPECT_EQ(mesh_hash(mesh), mesh_hash(wheel()));
  EXPECT_NE(mesh_hash(mesh), mesh_hash(moved));
  EXPECT_NE(mesh_hash(mesh), mesh_hash(turned));
}

TEST(SolidResults, FieldsAreAlongTheFixedAxes) {
  const Folder folder;
  const SolidRun run;
  write(folder, run);
  const h5::File file = h5::File::open(folder / "results.h5");
  const auto position = row_of<std::array<float, 3>>(file.dataset("/fields/position"), 0);
  const auto displacement = row_of<std::array<float, 3>>(file.dataset("/fields/displacement"), 0);
  const auto tensor = row_of<std::array<float, 6>>(file.dataset("/fields/cauchy_stress"), 0);
  const auto mises = row_of<float>(file.dataset("/fields/von_mises"), 0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).matrix();
  const Eigen::Vector3d n(0, std::cos(camber), std::sin(camber)), t1(1, 0, 0), t2 = t1.cross(n);
  const Eigen::Vector3d middle = center.x * t1 + center.y * n + lateral * t2;
  for (std::size_t i = 0; i < run.mesh.n_nodes(); ++i) {
    const Eigen::Vector3d x = middle + turn * (run.place_of(i) + run.u_of(i));
    const Eigen::Vector3d u = turn * run.u_of(i);
    const fem::SolidStress& s = run.stress[i];
    Eigen::Matrix3d sigma;
    sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const Eigen::Matrix3d fixed = turn * sigma * turn.transpose();
    const Eigen::Matrix3d deviator = sigma - sigma.trace() / 3.0 * Eigen::Matrix3d::Identity();
    EXPECT_NEAR(mises[i], std::sqrt(1.5) * deviator.norm(), 1e-5);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(position[i][static_cast<std::size_t>(c)], x[c], 1e-6);
      EXPECT_NEAR(displacement[i][static_cast<std::size_t>(c)], u[c], 1e-8);
    }
    constexpr std::array<std::array<int, 2>, 6> order{
        {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(tensor[i][k], fixed(order[k][0], order[k][1]), 1e-5);
  }
}

TEST(SolidResults, UnitsAreThoseOfABody) {
  const Folder folder;
  write(folder, SolidRun());
  const h5::File file = h5::File::open(folder / "results.h5");
  EXPECT_EQ(file.dataset("/mesh/mass").label().units, "kg");
  EXPECT_EQ(file.dataset("/mesh/tributary").label().units, "m2");
  EXPECT_EQ(file.dataset("/contact/force").label().units, "N");
  EXPECT_EQ(file.dataset("/fields/contact_force").label().units, "N");
  const std::string xdmf = text_of(folder / "fields.xdmf");
  EXPECT_TRUE(is_well_formed(xdmf));
  EXPECT_NE(xdmf.find("TopologyType=\"Hexahedron\" NumberOfElements=\"10\""), std::string::npos);
  EXPECT_NE(xdmf.find("\"stress_yz\""), std::string::npos);
}

}  // namespace
}  // namespace rondo::io::test::solid_results_test
