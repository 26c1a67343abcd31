// SPDX-License-Identifier: BSD-3-Clause
/// Snapshots of a run as the matrix of a POD: by rows as by columns, windows, frames, weights.
#include "rondo/study/pod/pod.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "rondo/core/error.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/io/results.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/study/pod/pod_report.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"

namespace pod_test {

using namespace rondo;
using namespace rondo::study;

namespace {

namespace fs = std::filesystem;
using pod::Index;

/// A run with random fields: `n` snapshots at t = 0, 1, ...; velocities half a second before.
class PodSnapshots : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rondo-pod-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    mesh::Disk disk;
    disk.radial = 2;
    disk.tread = mesh::Tread{.pitches = 7, .depth = 0.02, .land_columns = 2};
    mesh_ = mesh::make_disk(disk);
    const fem::Material rubber{2e7, 0.3, 1100.0};
    mass_ = fem::lumped_mass(mesh_, {&rubber, 1});
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path make(const std::string& name, std::size_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const fs::path directory = folder_ / name;
    fs::create_directories(directory);
    io::Results results(directory, {&mesh_, mass_, n, true, false});
    std::vector<Vec2> u(mesh_.n_nodes()), v(u.size());
    std::vector<Vec3> f(mesh_.boundary.size());
    for (std::size_t j = 0; j < n; ++j) {
      for (auto* field : {&u, &v})
        for (Vec2& value : *field) value = {normal(random), normal(random)};
      for (Vec3& value : f) value = {normal(random), normal(random), 0.0};
      io::Snapshot s;
      s.time = static_cast<double>(j);
      s.time_velocity = s.time - 0.5;
      s.angle = -0.3 * s.time;
      s.angle_velocity = -0.3 * s.time_velocity;
      s.u = u;
      s.v = v;
      results.write(s, {.contact_force = f, .contact_force_fixed = f});
    }
    results.close();
    return directory;
  }

  mesh::Mesh mesh_;
  std::vector<double> mass_;
  fs::path folder_;
};

std::vector<SnapshotColumn> all_columns(const io::RunReader& run, std::size_t index) {
  std::vector<SnapshotColumn> columns;
  for (std::size_t j = 0; j < run.n_snapshots(); ++j)
    columns.push_back({index, j, run.times().time[j], run.times().angle[j]});
  return columns;
}

}  // namespace

TEST_F(PodSnapshots, RowsAreThoseOfTheColumns) {
  std::vector<io::RunReader> runs;
  runs.emplace_back(make("a", 4, 1));
  runs.emplace_back(make("b", 3, 2));
  std::vector<SnapshotColumn> columns = all_columns(runs[0], 0);
  for (const SnapshotColumn& c : all_columns(runs[1], 1)) columns.push_back(c);
  for (const auto quantity : {io::Quantity::displacement, io::Quantity::contact})
    for (const auto& rectified : {std::optional<pod::Shift>{}, std::optional{pod::Shift::fourier},
                                  std::optional{pod::Shift::pitch}}) {
      const Weight weight = quantity == io::Quantity::contact ? Weight::delassus : Weight::mass;
      RunSnapshots snapshots(runs, columns, {quantity, weight, rectified});
      Eigen::MatrixXd whole(snapshots.rows(), snapshots.columns());
      snapshots.read_columns(0, whole);
      const Index grain = snapshots.row_grain();
      EXPECT_EQ(grain, rectified ? 2 * mesh_.n_sectors : 2);
      for (Index first = 0; first < whole.rows(); first += 2 * grain) {
        Eigen::MatrixXd part(std::min(2 * grain, whole.rows() - first), whole.cols());
        snapshots.read_rows(first, part);
        EXPECT_EQ(part, whole.middleRows(first, part.rows()));  // the same bits
      }
      // Both frames have the same energy in the weight's norm.
      double energy = 0.0;
      std::vector<Vec2> field(runs[1].n_points(quantity));
      runs[1].read(quantity, 2, 0, field);
      for (std::size_t k = 0; k < field.size(); ++k)
        energy += snapshots.weight()[k] * dot(field[k], field[k]);
      EXPECT_NEAR(whole.col(6).squaredNorm(), energy, 1e-13 * energy);
    }
}

TEST_F(PodSnapshots, UnweightGivesTheFieldInTheOrderOfTheMesh) {
  std::vector<io::RunReader> runs;
  runs.emplace_back(make("a", 1, 3));
  std::vector<SnapshotColumn> columns =
      all_columns(runs[0], 0);  // at θ = 0 both frames are the same
  RunSnapshots snapshots(runs, columns,
                         {io::Quantity::displacement, Weight::mass, pod::Shift::fourier});
  Eigen::MatrixXd column(snapshots.rows(), 1);
  snapshots.read_columns(0, column);
  snapshots.unweight(column.col(0));
  std::vector<Vec2> field(mesh_.n_nodes());
  runs[0].read(io::Quantity::displacement, 0, 0, field);
  for (std::size_t k = 0; k < field.size(); ++k) {
    EXPECT_NEAR(column(static_cast<Index>(2 * k), 0), field[k].x, 1e-14);
    EXPECT_NEAR(column(static_cast<Index>(2 * k + 1), 0), field[k].y, 1e-14);
  }
}

TEST_F(PodSnapshots, WindowsAreOfTheFieldsOwnTimes) {
  PodRequest request;
  request.runs = {make("a", 6, 4)};
  request.from = 2.0;
  request.to = 4.0;  // both ends included
  EXPECT_EQ(run_pod(request).snapshots, 3U);
  request.field = "velocity";  // at -0.5, 0.5, ...
  EXPECT_EQ(run_pod(request).snapshots, 2U);
  EXPECT_EQ(run_pod(request).runs.front().from, 2.5);
  request.from = 2.6;
  request.to = 3.4;
  EXPECT_THROW(static_cast<void>(run_pod(request)), InputError);
}

TEST_F(PodSnapshots, ErrorsByRunAddUpToThatOfAll) {
  PodRequest request;
  request.runs = {make("a", 5, 5), make("b", 3, 6)};
  request.directory = folder_ / "common";
  request.modes = 3;
  const PodReport report = run_pod(request);
  double share = 0.0, error = 0.0;
  for (const PodRun& run : report.runs) {
    share += run.energy_share;
    EXPECT_GT(run.energy_share, 0.25);  // 5 and 3 snapshots of the same size
    error += run.energy_share * run.error * run.error;
    // With the modes of a count its error is at most that share, over the run's own energy.
    for (std::size_t c = 0; c < report.counts.size(); ++c)
      EXPECT_FALSE(run.count_errors[c].has_value());  // takes more modes than were kept
  }
  EXPECT_NEAR(share, 1.0, 1e-14);
  EXPECT_NEAR(error, report.tail, 1e-13);
  EXPECT_GT(report.tail, 0.01);  // random fields: three modes of eight leave much
  request.modes = 8;
  const PodReport whole = run_pod(request);
  for (std::size_t c = 0; c < whole.counts.size(); ++c) {
    double left = 0.0;
    for (const PodRun& run : whole.runs)
      left += run.energy_share * std::pow(run.count_errors[c].value(), 2);
    EXPECT_LE(left, whole.counts[c].discarded);
  }
}

TEST(PodTrouble, IdentityAndOrthonormalityAreJudged) {
  PodReport r;
  r.residual = r.tail = 0.25;
  EXPECT_EQ(trouble_in(r), "");
  r.residual = 0.26;  // more is left than the spectrum says
  EXPECT_NE(trouble_in(r).find("identity"), std::string::npos);
  r.residual = 0.24;  // less: only what was cut may explain it
  EXPECT_NE(trouble_in(r), "");
  r.lost = 0.02;
  EXPECT_EQ(trouble_in(r), "");
  r.orthonormality = 1e-9;
  EXPECT_NE(trouble_in(r).find("orthonormal"), std::string::npos);
  r.orthonormality = std::nan("");
  EXPECT_NE(trouble_in(r), "");
}

}  // namespace pod_test
