// SPDX-License-Identifier: BSD-3-Clause
/// A POD of a wheel in three dimensions, from its files to its files: a pattern that stands in
/// space, with an axial component, and random fields.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "rondo/core/complex.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/results.hpp"
#include "rondo/mesh/solid/wheel.hpp"
#include "rondo/study/pod/pod.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"

namespace solid_pod_test {

using namespace rondo;
using namespace rondo::study;

namespace {

namespace fs = std::filesystem;
using pod::Index;

constexpr int n_sectors = 24;
constexpr std::size_t n_snapshots = 10;

mesh::Mesh make_mesh() {
  mesh::Wheel wheel;
  wheel.disk.outer_radius = 0.3;
  wheel.disk.inner_radius = 0.15;
  wheel.disk.radial = 2;
  wheel.disk.circumferential = n_sectors;
  wheel.width = 0.1;
  wheel.axial = 3;
  return mesh::make_wheel(wheel);
}

/// Radial, tangential and axial part of what stands still in space, at an angle there.
std::array<double, 3> pattern(double phi) {
  return {std::cos(phi) + 0.3 * std::sin(3.0 * phi), 0.5 * std::sin(2.0 * phi),
          0.7 * std::cos(4.0 * phi - 0.2)};
}

class SolidPod : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rondo-solid-pod-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    mass_.resize(mesh_.n_nodes());
    for (std::size_t k = 0; k < mass_.size(); ++k)  // the same all around a ring
      mass_[k] = 0.01 + 0.001 * mesh_.sector_node[k];
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// The pattern as the turning frame sees it, all snapshots with their angle.
  std::vector<Vec3> travelling(double angle) const {
    std::vector<Vec3> u;
    for (std::size_t k = 0; k < mesh_.n_nodes(); ++k) {
      const Complex direction = (1.0 / norm(mesh_.coordinates[k])) *
                                Complex{mesh_.coordinates[k].x, mesh_.coordinates[k].y};
      const double phi = std::atan2(mesh_.coordinates[k].y, mesh_.coordinates[k].x) + angle;
      const auto [radial, tangential, axial] = pattern(phi);
      const double weaker = 1.0 + mesh_.axial[k];
      const Vec2 plane = direction * Vec2{radial, tangential};
      u.push_back(weaker * Vec3(plane, axial));
    }
    return u;
  }

  std::vector<Vec3> random(std::size_t points) {
    std::vector<Vec3> values(points);
    for (Vec3& value : values) {
      value.x = normal_(engine_);
      value.y = normal_(engine_);
      value.z = normal_(engine_);
    }
    return values;
  }

  fs::path make(const std::string& name, bool travels) {
    const fs::path directory = folder_ / name;
    fs::create_directories(directory);
    io::ResultsLayout layout{&mesh_, mass_, n_snapshots, true, false};
    layout.components = 3;
    io::Results results(directory, layout);
    for (std::size_t j = 0; j < n_snapshots; ++j) {
      io::Snapshot s;
      s.time = static_cast<double>(j);
      s.time_velocity = s.time - 0.5;
      s.angle = -0.37 * s.time;
      s.angle_velocity = -0.37 * s.time_velocity;
      s.u = travels ? travelling(s.angle) : random(mesh_.n_nodes());
      s.v = random(mesh_.n_nodes());
      const std::vector<Vec3> f = random(mesh_.boundary.size());
      results.write(s, {.contact_force = f, .contact_force_fixed = f});
    }
    results.close();
    return directory;
  }

  const mesh::Mesh mesh_ = make_mesh();
  std::vector<double> mass_;
  fs::path folder_;
  std::mt19937 engine_{3};
  std::normal_distribution<double> normal_;
};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_F(SolidPod, APatternThatStandsInSpaceIsOneMode) {
  PodRequest request;
  request.runs = {make("travels", true)};
  request.frame = "rectified";
  const PodReport rectified = run_pod(request);
  EXPECT_EQ(rectified.trouble, "");
  EXPECT_EQ(rectified.rank, 1);
  EXPECT_EQ(rectified.rows, 3 * mesh_.n_nodes());
  request.frame = "co-rotating";
  const PodReport turning = run_pod(request);
  EXPECT_GT(turning.rank, 6);
  EXPECT_NEAR(rectified.energy, turning.energy, 1e-13 * turning.energy);  // an isometry
  // The energy in the weight's norm, all three components in it.
  double energy = 0.0;
  const std::vector<Vec3> u = travelling(0.0);
  for (std::size_t k = 0; k < u.size(); ++k) energy += mass_[k] * dot(u[k], u[k]);
  EXPECT_NEAR(rectified.energy, static_cast<double>(n_snapshots) * energy, 1e-12 * energy);
}

TEST_F(SolidPod, RowsAreThoseOfTheColumns) {
  std::vector<io::RunReader> runs;
  runs.emplace_back(make("random", false));
  std::vector<SnapshotColumn> columns;
  for (std::size_t j = 0; j < n_snapshots; ++j)
    columns.push_back({0, j, runs[0].times().time[j], runs[0].times().angle[j]});
  for (const auto quantity : {io::Quantity::displacement, io::Quantity::contact})
    for (const auto& rectified : {std::optional<pod::Shift>{}, std::optional{pod::Shift::fourier},
                                  std::optional{pod::Shift::pitch}}) {
      const Weight weight = quantity == io::Quantity::contact ? Weight::delassus : Weight::mass;
      RunSnapshots snapshots(runs, columns, {quantity, weight, rectified});
      Eigen::MatrixXd whole(snapshots.rows(), snapshots.columns());
      snapshots.read_columns(0, whole);
      const Index grain = snapshots.row_grain();
      EXPECT_EQ(grain, rectified ? 3 * n_sectors : 3);
      for (Index first = 0; first < whole.rows(); first += 2 * grain) {
        Eigen::MatrixXd part(std::min(2 * grain, whole.rows() - first), whole.cols());
        snapshots.read_rows(first, part);
        EXPECT_EQ(part, whole.middleRows(first, part.rows()));  // the same bits
      }
      std::vector<double> field(3 * runs[0].n_points(quantity));
      runs[0].read(quantity, 7, 0, {field, 3});
      double energy = 0.0;
      for (std::size_t k = 0; k < field.size(); ++k)
        energy += snapshots.weight()[k / 3] * field[k] * field[k];
      EXPECT_NEAR(whole.col(7).squaredNorm(), energy, 1e-13 * energy);
      // Back in the order of the mesh: at the angle 0 both frames are the same.
      Eigen::VectorXd first = whole.col(0);
      snapshots.unweight(first);
      runs[0].read(quantity, 0, 0, {field, 3});
      for (std::size_t k = 0; k < field.size(); ++k)
        EXPECT_NEAR(first[static_cast<Index>(k)], field[k], 1e-13);
    }
}

TEST_F(SolidPod, FilesHaveThreeComponentsAndHexahedra) {
  PodRequest request;
  request.runs = {make("random", false)};
  request.frame = "rectified";
  request.modes = 2;
  const PodReport report = run_pod(request);
  const io::h5::File file = io::h5::File::open(report.directory / "pod.h5");
  const std::size_t n = mesh_.n_nodes();
  EXPECT_NO_THROW(static_cast<void>(file.dataset("/modes/spatial", {2, n, 3})));
  EXPECT_EQ(file.attribute("/weight", "units"), "kg");
  EXPECT_EQ(file.attribute("/modes/spatial", "units"), "kg^(-1/2)");
  EXPECT_EQ(file.attribute("/spectrum/singular_value", "units"), "m kg^(1/2)");
  for (const char* name : {"modes.xdmf", "reconstruction.xdmf"}) {
    const std::string xdmf = text_of(report.directory / name);
    EXPECT_NE(xdmf.find("TopologyType=\"Hexahedron\""), std::string::npos) << name;
    EXPECT_NE(xdmf.find("GeometryType=\"XYZ\""), std::string::npos) << name;
    EXPECT_EQ(xdmf.find("GeometryType=\"XY\""), std::string::npos) << name;
  }
  request.field = "contact";
  const PodReport contact = run_pod(request);
  EXPECT_EQ(contact.unit, "N");
  EXPECT_EQ(contact.rows, 3 * mesh_.boundary.size());
  const std::string xdmf = text_of(contact.directory / "modes.xdmf");
  for (const char* name : {"\"normal\"", "\"tangential\"", "\"lateral\""})
    EXPECT_NE(xdmf.find(name), std::string::npos) << name;
}

}  // namespace solid_pod_test
