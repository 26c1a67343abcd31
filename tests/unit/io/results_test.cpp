// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/results.hpp"

#include "rondo/io/h5/h5.hpp"
#include "unit/io/support.hpp"

namespace rondo::io::test::results_test {
namespace {

using h5::Shape;

void write_all(const Folder& folder, SmallRun& run, std::size_t planned, std::size_t written) {
  Results results(folder.path(), run.layout(planned));
  for (std::size_t k = 0; k < written; ++k) run.write(k, results);
  results.close();
}

std::vector<std::pair<std::string, Shape>> expected(const SmallRun& r, std::size_t t) {
  const std::size_t n = r.n(), nb = r.nb();
  return {{"/mesh/coordinates", {n, 2}},
          {"/mesh/cells", {r.mesh.cells.size(), 4}},
          {"/mesh/boundary", {nb}},
          {"/mesh/tributary", {nb}},
          {"/mesh/mass", {n}},
          {"/mesh/sector", {n}},
          {"/mesh/sector_node", {n}},
          {"/frame/time", {t}},
          {"/frame/time_velocity", {t}},
          {"/frame/angle", {t}},
          {"/frame/angle_velocity", {t}},
          {"/frame/center", {t, 2}},
          {"/snapshots/displacement", {t, n, 2}},
          {"/snapshots/velocity", {t, n, 2}},
          {"/contact/force", {t, nb, 2}},
          {"/contact/traction", {t, nb, 2}},
          {"/fields/position", {t, n, 3}},
          {"/fields/displacement", {t, n, 3}},
          {"/fields/contact_force", {t, n, 3}},
          {"/fields/von_mises", {t, n}},
          {"/fields/cauchy_stress", {t, n, 6}}};
}

TEST(Results, EveryDatasetHasItsShapeUnitsAndDescription) {
  const Folder folder;
  SmallRun run;
  write_all(folder, run, 3, 3);
  const h5::File file = h5::File::open(folder / "results.h5");
  for (const auto& [name, shape] : expected(run, 3)) {
    ASSERT_TRUE(file.contains(name)) << name;
    const h5::Dataset dataset = file.dataset(name);
    EXPECT_EQ(dataset.shape(), shape) << name;
    EXPECT_FALSE(dataset.label().units.empty()) << name;
    EXPECT_FALSE(dataset.label().description.empty()) << name;
  }
}

/// However the first run ended: the files are those of a run that did not stop.
TEST(Results, GoOnAfterTheSnapshotsThatAreKept) {
  SmallRun run;
  const Folder whole;
  write_all(whole, run, 5, 5);
  for (const bool closed : {false, true}) {
    const Folder folder;
    auto first = std::make_unique<Results>(folder.path(), run.layout(5));
    for (std::size_t k = 0; k < 3; ++k) run.write(k, *first);
    if (closed) first->close();
    Results again(folder.path(), run.layout(5), 2);
    EXPECT_EQ(again.written(), 2U);
    for (std::size_t k = 2; k < 5; ++k) run.write(k, again);
    again.close();
    for (const char* name : {"results.h5", "fields.xdmf", "fields.vtkhdf"})
      EXPECT_EQ(text_of(folder / name), text_of(whole / name)) << name << closed;
  }
}

TEST(Results, DoNotGoOnAfterSnapshotsThatAreNotThere) {
  const Folder folder;
  SmallRun run;
  write_all(folder, run, 5, 2);
  const std::string before = text_of(folder / "results.h5");
  const std::string what =
      error_of<FileError>([&] { const Results again(folder.path(), run.layout(5), 3); });
  EXPECT_NE(what.find("holds less than it did: damaged"), std::string::npos) << what;
  EXPECT_EQ(text_of(folder / "results.h5"), before);
}

TEST(Results, WhatWasGivenIsReadBack) {
  const Folder folder;
  SmallRun run;
  write_all(folder, run, 3, 3);
  const h5::File file = h5::File::open(folder / "results.h5");
  EXPECT_EQ(file.read<Vec2>("/mesh/coordinates"), run.mesh.coordinates);
  EXPECT_EQ(file.read<mesh::Cell>("/mesh/cells"), run.mesh.cells);
  EXPECT_EQ(file.read<int>("/mesh/boundary"), run.mesh.boundary);
  EXPECT_EQ(file.read<double>("/mesh/tributary"), run.mesh.tributary);
  EXPECT_EQ(file.read<double>("/mesh/mass"), run.mass);
  EXPECT_EQ(file.read<int>("/mesh/sector_node"), run.mesh.sector_node);
  for (std::size_t k = 0; k < 3; ++k) {
    const Snapshot s = run.snapshot(k);
    EXPECT_EQ(file.read<double>("/frame/time")[k], s.time);
    EXPECT_EQ(file.read<double>("/frame/time_velocity")[k], s.time_velocity);
    EXPECT_EQ(file.read<double>("/frame/angle")[k], s.angle);
    EXPECT_EQ(file.read<double>("/frame/angle_velocity")[k], s.angle_velocity);
    EXPECT_EQ(file.read<Vec2>("/frame/center")[k], s.center.plane());
    const auto same = [&](const char* name, const FieldView& values) {
      EXPECT_EQ(row_of<Vec2>(file.dataset(name), k), points_of(values));
    };
    same("/snapshots/displacement", s.u);
    same("/snapshots/velocity", s.v);
    same("/contact/force", run.fields(k).contact_force);
  }
}

TEST(Results, FieldsAreInTheFixedFrame) {
  const Folder folder;
  SmallRun run;
  write_all(folder, run, 3, 3);
  const h5::File file = h5::File::open(folder / "results.h5");
  const Snapshot s = run.snapshot(2);
  const double c = std::cos(s.angle), sn = std::sin(s.angle);
  const auto position = row_of<std::array<float, 3>>(file.dataset("/fields/position"), 2);
  const auto turned = row_of<std::array<float, 3>>(file.dataset("/fields/displacement"), 2);
  for (std::size_t i = 0; i < run.n(); ++i) {
    const Vec2 u = s.u.plane()[i], x = run.mesh.coordinates[i] + u;
    // single precision of numbers below 10
    EXPECT_NEAR(position[i][0], s.center.x + c * x.x - sn * x.y, 1e-6);
    EXPECT_NEAR(position[i][1], s.center.y + sn * x.x + c * x.y, 1e-6);
    EXPECT_NEAR(turned[i][0], c * u.x - sn * u.y, 1e-6);
    EXPECT_NEAR(turned[i][1], sn * u.x + c * u.y, 1e-6);
    EXPECT_EQ(position[i][2], 0.0F);
    EXPECT_NEAR(std::hypot(turned[i][0], turned[i][1]), norm(u), 1e-6);
  }
}

TEST(Results, ContactForceIsOnTheCandidatesAndTractionPerLength) {
  const Folder folder;
  SmallRun run;
  write_all(folder, run, 2, 2);
  const h5::File file = h5::File::open(folder / "results.h5");
  const auto field = row_of<std::array<float, 3>>(file.dataset("/fields/contact_force"), 1);
  const auto traction = row_of<Vec2>(file.dataset("/contact/traction"), 1);
  const SnapshotFields s = run.fields(1);
  std::size_t loaded = 0;
  for (const auto& f : field) loaded += f[1] != 0.0F ? 1 : 0;
  EXPECT_EQ(loaded, run.nb());
  for (std::size_t b = 0; b < run.nb(); ++b) {
    const auto& f = field[static_cast<std::size_t>(run.mesh.boundary[b])];
    EXPECT_EQ(f[0], static_cast<float>(s.contact_force_fixed[b].x));
    EXPECT_EQ(f[1], static_cast<float>(s.contact_force_fixed[b].y));
    EXPECT_EQ(traction[b].x, s.contact_force[b].x / run.mesh.tributary[b]);
    EXPECT_EQ(traction[b].y, s.contact_force[b].y / run.mesh.tributary[b]);
  }
}

/// Fields in space: x and y turn with the frame, z stays.
TEST(Results, VectorsOfThreeComponents) {
  const Folder folder;
  SmallRun run;
  ResultsLayout layout = run.layout(1);
  layout.components = 3;
  layout.contact = false;
  Snapshot s = run.snapshot(0);
  const std::vector<Vec2> plane = to_vector(s.u.plane());
  std::vector<Vec3> u;
  for (std::size_t i = 0; i < run.n(); ++i) u.push_back({plane[i], 0.25 * static_cast<double>(i)});
  s.u = s.v = u;
  Results results(folder.path(), layout);
  SnapshotFields fields = run.fields(0);
  fields.contact_force = fields.contact_force_fixed = {};
  results.write(s, fields);
  results.close();
  const h5::File file = h5::File::open(folder / "results.h5");
  EXPECT_EQ(file.dataset("/snapshots/displacement").shape(), (h5::Shape{1, run.n(), 3}));
  EXPECT_EQ(file.read<Vec3>("/snapshots/displacement"), u);
  const auto turned = row_of<std::array<float, 3>>(file.dataset("/fields/displacement"), 0);
  for (std::size_t i = 0; i < run.n(); ++i) {
    const Vec2 expected = rotation(s.angle) * plane[i];
    EXPECT_EQ(turned[i][0], static_cast<float>(expected.x));
    EXPECT_EQ(turned[i][1], static_cast<float>(expected.y));
    EXPECT_EQ(turned[i][2], static_cast<float>(u[i].z));
  }
}

TEST(Results, StressTurnsWithTheFrame) {
  const Folder folder;
  SmallRun run;
  write_all(folder, run, 2, 2);
  const h5::File file = h5::File::open(folder / "results.h5");
  const auto tensor = row_of<std::array<float, 6>>(file.dataset("/fields/cauchy_stress"), 1);
  const Snapshot s = run.snapshot(1);
  const SnapshotFields fields = run.fields(1);
  const double c = std::cos(s.angle), sn = std::sin(s.angle);
  const double turn[2][2] = {{c, -sn}, {sn, c}};
  for (std::size_t i = 0; i < run.n(); ++i) {
    const auto& [xx, yy, zz, xy] = fields.stress[i];
    const double sigma[2][2] = {{xx, xy}, {xy, yy}};
    double fixed[2][2] = {};  // R σ R^T, index by index
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        for (int p = 0; p < 2; ++p)
          for (int q = 0; q < 2; ++q) fixed[a][b] += turn[a][p] * sigma[p][q] * turn[b][q];
    const double eps = 0.05;  // single precision of 3e5 Pa is 0.03 Pa
    EXPECT_NEAR(tensor[i][0], fixed[0][0], eps);
    EXPECT_NEAR(tensor[i][1], fixed[0][1], eps);
    EXPECT_NEAR(tensor[i][3], fixed[1][1], eps);
    EXPECT_NEAR(tensor[i][5], zz, eps);
    EXPECT_EQ(tensor[i][2], 0.0F);
    EXPECT_EQ(tensor[i][4], 0.0F);
  }
}

TEST(Results, VonMisesOfKnownStates) {
  const Folder folder;
  SmallRun run;
  Results results(folder.path(), run.layout(1));
  std::vector<fem::Stress> stress(run.n(), fem::Stress{5e6, 5e6, 5e6, 0.0});  // pressure: none
  stress[1] = {7e6, 0.0, 0.0, 0.0};                                           // tension: itself
  stress[2] = {0.0, 0.0, 0.0, 2e6};                                           // shear: √3 τ
  stress[3] = {0.0, 0.0, -7e6, 0.0};                                          // out of plane counts
  SnapshotFields fields = run.fields(0);
  fields.stress = stress;
  results.write(run.snapshot(0), fields);
  results.close();
  const auto v = h5::File::open(folder / "results.h5").read<float>("/fields/von_mises");
  EXPECT_EQ(v[0], 0.0F);
  EXPECT_FLOAT_EQ(v[1], 7e6F);
  EXPECT_FLOAT_EQ(v[2], std::sqrt(3.0F) * 2e6F);
  EXPECT_FLOAT_EQ(v[3], 7e6F);
}

TEST(Results, WithoutGroundAndStressTheirDatasetsAreAbsent) {
  const Folder folder;
  SmallRun run;
  ResultsLayout layout = run.layout(1);
  layout.contact = layout.stress = false;
  Results results(folder.path(), layout);
  results.write(run.snapshot(0), {});
  results.close();
  const h5::File file = h5::File::open(folder / "results.h5");
  EXPECT_FALSE(file.contains("/contact/force"));
  EXPECT_FALSE(file.contains("/fields/contact_force"));
  EXPECT_FALSE(file.contains("/fields/von_mises"));
  EXPECT_TRUE(file.contains("/fields/displacement"));
  EXPECT_EQ(text_of(folder / "fields.xdmf").find("von_mises"), std::string::npos);
}

TEST(Results, TrianglesAndMixedMeshes) {
  const Folder folder;
  SmallRun run;
  const mesh::Cell q = run.mesh.cells[0];
  const mesh::Cell half1 = {q[0], q[1], q[2], -1}, half2 = {q[0], q[2], q[3], -1};
  run.mesh.cells[0] = half1;
  run.mesh.cells.push_back(half2);
  write_all(folder, run, 1, 1);
  {
    const h5::File file = h5::File::open(folder / "results.h5");
    EXPECT_EQ(file.read<mesh::Cell>("/mesh/cells"), run.mesh.cells);
    const auto list = file.read<int>("/mesh/cells_mixed");
    EXPECT_EQ(list.size(), 5 * run.mesh.cells.size() - 2);
    EXPECT_EQ((std::vector<int>(list.begin(), list.begin() + 5)),
              (std::vector<int>{4, q[0], q[1], q[2], 5}));
  }
  run.mesh.cells = {half1, half2};
  write_all(folder, run, 1, 1);
  const h5::File file = h5::File::open(folder / "results.h5");
  EXPECT_EQ(file.dataset("/mesh/cells").shape(), (Shape{2, 3}));
  EXPECT_FALSE(file.contains("/mesh/cells_mixed"));
  EXPECT_NE(text_of(folder / "fields.xdmf").find("\"Triangle\""), std::string::npos);
}

TEST(Results, CloseCutsToWhatWasWrittenAndTheFileGetsShorter) {
  const Folder folder;
  SmallRun run(64, 8);
  const std::size_t planned = 1000, written = 20;
  write_all(folder, run, planned, written);
  const h5::File file = h5::File::open(folder / "results.h5");
  for (const auto& [name, shape] : expected(run, written))
    EXPECT_EQ(file.dataset(name).shape(), shape) << name;
  EXPECT_EQ(file.read<double>("/frame/time").back(), run.snapshot(written - 1).time);
  // rows are reserved in 64 parts: of the 1000 snapshots at most 20 + 1000/64 are left
  const std::size_t full = Results::bytes(run.layout(planned));
  EXPECT_LT(std::filesystem::file_size(folder / "results.h5"), full / 10);
}

TEST(Results, SizeIsForetold) {
  const Folder folder;
  SmallRun run(64, 8);
  write_all(folder, run, 200, 200);
  const auto size = static_cast<double>(std::filesystem::file_size(folder / "results.h5"));
  EXPECT_NEAR(static_cast<double>(Results::bytes(run.layout(200))), size, 0.01 * size);
}

TEST(Results, NoSnapshotsPlannedOrWritten) {
  const Folder folder;
  SmallRun run;
  write_all(folder, run, 0, 0);
  EXPECT_FALSE(h5::File::open(folder / "results.h5").contains("/frame/time"));
  EXPECT_EQ(h5::File::open(folder / "results.h5").read<double>("/mesh/mass"), run.mass);
  write_all(folder, run, 5, 0);
  EXPECT_EQ(h5::File::open(folder / "results.h5").dataset("/frame/time").shape(), Shape{0});
}

TEST(Results, SameValuesGiveTheSameBytes) {
  const Folder a, b;
  SmallRun run;
  write_all(a, run, 4, 3);
  write_all(b, run, 4, 3);
  EXPECT_EQ(text_of(a / "results.h5"), text_of(b / "results.h5"));
  EXPECT_EQ(text_of(a / "fields.xdmf"), text_of(b / "fields.xdmf"));
  EXPECT_EQ(text_of(a / "fields.vtkhdf"), text_of(b / "fields.vtkhdf"));
}

}  // namespace
}  // namespace rondo::io::test::results_test
