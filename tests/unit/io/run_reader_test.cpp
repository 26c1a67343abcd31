// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/run_reader.hpp"

#include <functional>
#include <limits>

#include "rondo/io/files.hpp"
#include "rondo/io/mesh_files.hpp"
#include "unit/io/support.hpp"

namespace rondo::io::test::run_reader_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void write_run(const std::filesystem::path& directory, SmallRun& run, std::size_t planned,
               std::size_t written) {
  Results results(directory, run.layout(planned));
  for (std::size_t k = 0; k < written; ++k) run.write(k, results);
  results.close();
}

std::vector<Vec2> whole(const RunReader& reader, Quantity quantity, std::size_t snapshot) {
  std::vector<Vec2> values(reader.n_points(quantity));
  reader.read(quantity, snapshot, 0, values);
  return values;
}

void expect_snapshots(const RunReader& reader, SmallRun& run, std::size_t n) {
  ASSERT_EQ(reader.n_snapshots(), n);
  const RunTimes& t = reader.times();
  for (const auto* values : {&t.time, &t.time_velocity, &t.angle, &t.angle_velocity})
    ASSERT_EQ(values->size(), n);
  for (std::size_t k = 0; k < n; ++k) {
    const Snapshot s = run.snapshot(k);
    EXPECT_EQ(t.time[k], s.time);
    EXPECT_EQ(t.time_velocity[k], s.time_velocity);
    EXPECT_EQ(t.angle[k], s.angle);
    EXPECT_EQ(t.angle_velocity[k], s.angle_velocity);
    const auto same = [&](Quantity quantity, const FieldView& values) {
      EXPECT_EQ(whole(reader, quantity, k), points_of(values));
    };
    same(Quantity::displacement, s.u);
    same(Quantity::velocity, s.v);
    same(Quantity::contact, run.fields(k).contact_force);
  }
}

TEST(RunReader, RunThatEnded) {
  const Folder folder;
  SmallRun run;
  write_run(folder.path(), run, 5, 5);
  write_json(folder / "run.json", {{"status", "done"}, {"title", "a small run"}});
  const RunReader reader(folder.path());
  EXPECT_EQ(reader.directory(), folder.path());
  EXPECT_EQ(reader.title(), "a small run");
  EXPECT_EQ(reader.status(), "done");
  EXPECT_EQ(reader.n_planned(), 5U);
  EXPECT_EQ(reader.mass(), run.mass);
  EXPECT_EQ(reader.n_points(Quantity::displacement), run.n());
  EXPECT_EQ(reader.n_points(Quantity::velocity), run.n());
  EXPECT_EQ(reader.n_points(Quantity::contact), run.nb());
  expect_snapshots(reader, run, 5);
}

TEST(RunReader, InterruptedRunIsCutToWhatWasWritten) {
  const Folder folder;
  SmallRun run;
  write_run(folder.path(), run, 5, 2);
  const RunReader reader(folder.path());
  EXPECT_EQ(reader.n_planned(), 2U);
  expect_snapshots(reader, run, 2);
}

TEST(RunReader, KilledRunHasItsCompleteSnapshots) {
  const Folder folder;
  SmallRun run;
  ASSERT_TRUE(went_well(in_child([&] {
    Results results(folder.path(), run.layout(5));
    for (std::size_t k = 0; k < 3; ++k) run.write(k, results);
    std::_Exit(0);
  })));
  write_json(folder / "run.json", {{"status", "running"}, {"title", "t"}});
  const RunReader reader(folder.path());
  EXPECT_EQ(reader.status(), "running");
  EXPECT_EQ(reader.n_planned(), 5U);
  expect_snapshots(reader, run, 3);
}

TEST(RunReader, RunningRunMayEndMeanwhile) {
  const Folder folder;
  SmallRun run;
  Results results(folder.path(), run.layout(500));
  for (std::size_t k = 0; k < 3; ++k) run.write(k, results);
  ASSERT_TRUE(went_well(in_child([&] {  // HDF5 shares what one process opens twice
    const RunReader reader(folder.path());
    expect_snapshots(reader, run, 3);
    if (::testing::Test::HasFailure()) std::_Exit(1);
  })));
  int told[2], asked[2];
  ASSERT_TRUE(::pipe(told) == 0 && ::pipe(asked) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const RunReader reader(folder.path());
    char byte = 'o';
    if (::write(told[1], &byte, 1) != 1 || ::read(asked[0], &byte, 1) != 1) std::_Exit(2);
    expect_snapshots(reader, run, 3);  // the file has been cut since
    std::_Exit(::testing::Test::HasFailure() ? 1 : 0);
  }
  char byte = 0;
  ASSERT_EQ(::read(told[0], &byte, 1), 1);
  results.close();
  ASSERT_EQ(::write(asked[1], &byte, 1), 1);
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(went_well(status));
  for (const int end : {told[0], told[1], asked[0], asked[1]}) ::close(end);
}

TEST(RunReader, TellsTheAnalysis) {
  const Folder folder;
  SmallRun run;
  write_run(folder.path(), run, 1, 1);
  EXPECT_EQ(RunReader(folder.path()).analysis(), "dynamic");
  ResultsLayout layout = run.layout(2);
  layout.words.analysis = "crush";
  layout.words.time_unit = "1";
  layout.series = {{"/crush/depth", "m", "a number"}, {"/crush/force", "N/m", "a vector", 2}};
  {
    Results results(folder.path(), layout);
    Snapshot s = run.snapshot(0);
    s.series = {0.25, 7.0, -2.0};
    results.write(s, run.fields(0));
    results.close();
  }
  EXPECT_EQ(RunReader(folder.path()).analysis(), "crush");
  EXPECT_FALSE(RunReader(folder.path()).is_motion());
  {
    const h5::File file = h5::File::open(folder / "results.h5");
    EXPECT_EQ(file.read<double>("/crush/depth"), std::vector<double>{0.25});
    EXPECT_EQ(file.read<Vec2>("/crush/force"), (std::vector<Vec2>{{7.0, -2.0}}));
  }
  {  // of an earlier version
    h5::File file = h5::File::create(folder / "results.h5");
    file.set_attribute("/", "format", "rondo results 1");
    write_mesh(file, run.mesh, run.mass);
  }
  EXPECT_EQ(RunReader(folder.path()).analysis(), "dynamic");
  layout.words.time_unit = "h";
  { Results results(folder.path(), layout); }
  const std::string wrong = error_of<FileError>([&] { RunReader reader(folder.path()); });
  EXPECT_NE(wrong.find("/frame/time is in \"h\""), std::string::npos) << wrong;
}

TEST(RunReader, RunWithoutSnapshotsOrGround) {
  const Folder folder;
  SmallRun run;
  write_run(folder.path(), run, 0, 0);
  {
    const RunReader reader(folder.path());
    EXPECT_EQ(reader.n_snapshots(), 0U);
    EXPECT_EQ(reader.n_planned(), 0U);
    EXPECT_FALSE(reader.has(Quantity::displacement));
  }
  ResultsLayout layout = run.layout(1);
  layout.contact = layout.stress = false;
  Results results(folder.path(), layout);
  results.write(run.snapshot(0), {});
  results.close();
  const RunReader reader(folder.path());
  EXPECT_EQ(reader.n_snapshots(), 1U);
  EXPECT_FALSE(reader.has(Quantity::contact));
  EXPECT_TRUE(reader.has(Quantity::displacement) && reader.has(Quantity::velocity));
}

TEST(RunReader, MissingOrDamagedSummaryIsUnknown) {
  const Folder folder;
  SmallRun run;
  write_run(folder.path(), run, 1, 1);
  for (const char* text :
       {"", "{\"status\": \"run", "[1, 2]", "{\"status\": 3, \"title\": null}"}) {
    if (*text != '\0') put_text(folder / "run.json", text);
    const RunReader reader(folder.path());
    EXPECT_EQ(reader.status(), "unknown") << text;
    EXPECT_EQ(reader.title(), "unknown") << text;
  }
}

TEST(RunReader, MeshComesBackSmoothAndTreaded) {
  mesh::Disk smooth, treaded;
  smooth.radial = 2, smooth.circumferential = 12;
  treaded.radial = 2, treaded.tread = mesh::Tread{};
  for (const mesh::Disk& disk : {smooth, treaded}) {
    const Folder folder;
    SmallRun run;
    run.mesh = mesh::make_disk(disk);
    run.mass.assign(run.n(), 0.5);
    write_run(folder.path(), run, 1, 1);
    const RunReader reader(folder.path());
    const mesh::Mesh& m = reader.mesh();
    EXPECT_EQ(m.coordinates, run.mesh.coordinates);
    EXPECT_EQ(m.cells, run.mesh.cells);
    EXPECT_EQ(m.boundary, run.mesh.boundary);
    EXPECT_EQ(m.tributary, run.mesh.tributary);
    EXPECT_EQ(m.n_sectors, run.mesh.n_sectors);
    EXPECT_GT(m.n_sectors, 0);
    EXPECT_EQ(m.sector, run.mesh.sector);
    EXPECT_EQ(m.sector_node, run.mesh.sector_node);
    EXPECT_TRUE(m.clamped.empty());
  }
}

TEST(RunReader, MeshOfTrianglesWithoutSectors) {
  const Folder folder;
  SmallRun run;
  const mesh::Cell q = run.mesh.cells[0];
  run.mesh.cells = {{q[0], q[1], q[2], -1}, {q[0], q[2], q[3], -1}};
  run.mesh.n_sectors = 0;
  run.mesh.sector.clear(), run.mesh.sector_node.clear();
  write_run(folder.path(), run, 1, 1);
  const RunReader reader(folder.path());
  EXPECT_EQ(reader.mesh().cells, run.mesh.cells);
  EXPECT_EQ(reader.mesh().n_sectors, 0);
  EXPECT_TRUE(reader.mesh().sector.empty());
}

TEST(RunReader, PartsAreThoseOfTheWhole) {
  const Folder folder;
  SmallRun run(16, 3);
  write_run(folder.path(), run, 3, 3);
  const RunReader reader(folder.path());
  for (const auto quantity : {Quantity::displacement, Quantity::velocity, Quantity::contact}) {
    const std::vector<Vec2> all = whole(reader, quantity, 1);
    for (const std::size_t length : {std::size_t{1}, std::size_t{7}, all.size()})
      for (std::size_t first = 0; first < all.size(); first += length) {
        const std::size_t n = std::min(length, all.size() - first);
        std::vector<Vec2> part(n + 1, Vec2{nan, nan});  // nothing is written behind the part
        reader.read(quantity, 1, first, std::span(part).first(n));
        EXPECT_TRUE(std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(n),
                               all.begin() + static_cast<std::ptrdiff_t>(first)));
        EXPECT_TRUE(std::isnan(part[n].x));
      }
    reader.read(quantity, 1, all.size(), std::span<Vec2>());
  }
}

/// Bytes this process has read from files so far, by the kernel's count.
std::size_t bytes_read() {
  std::ifstream in("/proc/self/io");
  std::string name;
  std::size_t value = 0;
  in >> name >> value;
  return value;
}

/// A row is a chunk: HDF5 must not read it whole, to keep it, for the sake of a part.
TEST(RunReader, APartCostsNoMoreThanItself) {
  const Folder folder;
  SmallRun run(1000, 20);
  write_run(folder.path(), run, 2, 2);
  const RunReader reader(folder.path());
  std::vector<Vec2> part(2000);
  reader.read(Quantity::displacement, 0, 0, part);  // reads the index of the chunks as well
  const std::size_t before = bytes_read();
  const std::size_t of_counting = bytes_read() - before;
  reader.read(Quantity::displacement, 1, 4000, part);
  const std::size_t read = bytes_read() - before - 2 * of_counting;
  const std::size_t bytes = part.size() * sizeof(Vec2);
  EXPECT_GE(read, bytes);
  EXPECT_LE(read, bytes + bytes / 10);  // besides the values: the index of the chunks
}

TEST(RunReader, NoRunIsTheUsersFault) {
  const Folder folder;
  const auto what = [](const std::filesystem::path& path) {
    return error_of<InputError>([&] { const RunReader reader(path); });
  };
  for (const auto& [path, found] : {std::pair(folder / "none", "there is no such directory"),
                                    std::pair(folder.path(), "holds no results.h5")}) {
    EXPECT_NE(what(path).find("RUN = " + path.string() + ": " + found), std::string::npos);
    EXPECT_NE(what(path).find("rondo run CASE.toml -o RUN"), std::string::npos);
  }
  put_text(folder / "file", "x");
  EXPECT_NE(what(folder / "file").find("is not a directory"), std::string::npos);
}

TEST(RunReader, ForeignAndTruncatedFiles) {
  const Folder folder;
  SmallRun run;
  const auto what = [&] {
    return error_of<FileError>([&] { const RunReader reader(folder.path()); });
  };
  put_text(folder / "results.h5", "some text, and not too short to be looked at");
  EXPECT_NE(what().find("results.h5: cannot open"), std::string::npos) << what();
  h5::File::create(folder / "results.h5").close();
  EXPECT_NE(what().find("its format is \"none\""), std::string::npos) << what();
  {
    h5::File file = h5::File::create(folder / "results.h5");
    file.set_attribute("/", "format", "rondo results 2");
  }
  EXPECT_NE(what().find("its format is \"rondo results 2\""), std::string::npos) << what();
  write_run(folder.path(), run, 2, 2);
  const auto size = std::filesystem::file_size(folder / "results.h5");
  for (const std::size_t part : {0U, 10U, 50U, 90U, 99U}) {
    write_run(folder.path(), run, 2, 2);
    std::filesystem::resize_file(folder / "results.h5", size * part / 100);
    EXPECT_NE(what(), "") << part;
  }
}

/// A file made by hand, with one thing wrong.
struct Hand {
  SmallRun run;
  std::vector<double> time = {0.0, 0.1, nan}, time_velocity = {0.0, 0.05, nan};
  std::size_t angles = 3, displacements = 3, velocities = 3, nodes = 0;
  bool mesh = true, frame = true, snapshots = true;

  void write(const std::filesystem::path& path) const {
    h5::File file = h5::File::create(path);
    file.set_attribute("/", "format", "rondo results 1");
    if (mesh) write_mesh(file, run.mesh, run.mass);
    const auto zeros = [&](const char* name, const h5::Shape& shape) {
      std::size_t n = 1;
      for (const std::size_t size : shape) n *= size;
      const std::vector<double> values(n, 0.0);
      file.write(name, shape, std::span<const double>(values), {"1", "zeros"});
    };
    if (frame) {
      file.write("/frame/time", {time.size()}, std::span<const double>(time), {"s", "time"});
      file.write("/frame/time_velocity", {3}, std::span<const double>(time_velocity),
                 {"s", "time"});
      zeros("/frame/angle", {angles});
    }
    if (snapshots) zeros("/snapshots/displacement", {displacements, run.n() + nodes, 2});
    if (snapshots) zeros("/snapshots/velocity", {velocities, run.n(), 2});
  }
};

TEST(RunReader, FileOfAnEarlierVersionHasNoAngleOfTheVelocity) {
  const Folder folder;
  Hand().write(folder / "results.h5");
  const RunReader reader(folder.path());
  EXPECT_EQ(reader.n_snapshots(), 2U);
  EXPECT_EQ(reader.n_planned(), 3U);
  EXPECT_EQ(reader.times().angle.size(), 2U);
  EXPECT_TRUE(reader.times().angle_velocity.empty());
}

TEST(RunReader, WhatDoesNotFitIsNamed) {
  const Folder folder;
  const auto expect = [&](const char* text, const std::function<void(Hand&)>& change) {
    Hand hand;
    change(hand);
    hand.write(folder / "results.h5");
    const std::string what = error_of<FileError>([&] { const RunReader reader(folder.path()); });
    EXPECT_NE(what.find("results.h5: "), std::string::npos) << text;
    EXPECT_NE(what.find(text), std::string::npos) << "found: " << what << "\nexpected: " << text;
  };
  expect("cannot open /mesh/coordinates", [](Hand& h) { h.mesh = false; });
  expect("cannot open /frame/time", [](Hand& h) { h.frame = false; });
  expect("times without /snapshots", [](Hand& h) { h.snapshots = false; });
  expect("/frame/angle has the shape (4) where (3)", [](Hand& h) { h.angles = 4; });
  expect("/snapshots/displacement has the shape (2, 24, 2) where (3, 24, 2)",
         [](Hand& h) { h.displacements = 2; });
  expect("/snapshots/velocity has the shape (4, 24, 2)", [](Hand& h) { h.velocities = 4; });
  expect("/snapshots/displacement has the shape (3, 25, 2)", [](Hand& h) { h.nodes = 1; });
  expect("/frame/time[1] = 0: times must rise", [](Hand& h) { h.time = {0.0, 0.0, 0.1}; });
  expect("/frame/time[2] = 0.1", [](Hand& h) { h.time = {0.0, nan, 0.1}; });
  expect("/frame/time_velocity[1] = 0 after 0: times must rise", [](Hand& h) {
    h.time_velocity = {0.0, 0.0, 0.1};
  });
  expect("/mesh has cell 1 with a node", [](Hand& h) { h.run.mesh.cells[1][2] = 24; });
  expect("/mesh has contact node -1", [](Hand& h) { h.run.mesh.boundary[2] = -1; });
  expect("/mesh has node 3 at a place that is not",
         [](Hand& h) { h.run.mesh.coordinates[3].y = nan; });
  expect("/mesh has node 2 with the mass 0", [](Hand& h) { h.run.mass[2] = 0.0; });
  expect("/mesh has node 2 with the mass 1e-320", [](Hand& h) { h.run.mass[2] = 1e-320; });
  expect("/mesh has 24 nodes in 9 sectors", [](Hand& h) { h.run.mesh.sector[4] = 8; });
  expect("/mesh has node 4 at place", [](Hand& h) { h.run.mesh.sector[4] = 0; });
  expect("/mesh has node 4 at place 3 of", [](Hand& h) { h.run.mesh.sector_node[4] = 3; });
}

TEST(MeshDifference, NamesWhatDiffersFirst) {
  const Folder folder;
  std::filesystem::create_directory(folder / "a");
  std::filesystem::create_directory(folder / "b");
  Hand().write(folder / "a/results.h5");
  const RunReader a(folder / "a");
  const auto difference = [&](const std::function<void(Hand&)>& change) {
    Hand hand;
    change(hand);
    hand.write(folder / "b/results.h5");
    return mesh_difference(a, RunReader(folder / "b"));
  };
  EXPECT_EQ(difference([](Hand&) {}), "");
  EXPECT_EQ(difference([](Hand& h) { h.run = SmallRun(9, 2); }), "24 nodes against 27");
  EXPECT_EQ(difference([](Hand& h) { h.run.mesh.cells.pop_back(); }), "16 cells against 15");
  EXPECT_EQ(difference([](Hand& h) { h.run.mesh.n_sectors = 0; }), "8 sectors against 0");
  EXPECT_EQ(difference([](Hand& h) { h.run.mesh.coordinates[17].x += 1e-3; }),
            "coordinates differ at node 17 by 0.001 m");
  EXPECT_EQ(difference([](Hand& h) { std::swap(h.run.mesh.cells[3], h.run.mesh.cells[4]); }),
            "cells differ at cell 3");
  EXPECT_EQ(difference([](Hand& h) { h.run.mesh.boundary[1] = 0; }),
            "contact nodes differ: number 1 is node 5 against 0");
  EXPECT_EQ(difference([](Hand& h) { h.run.mesh.tributary[1] += 0.5; }),
            "tributary lengths differ at contact node 1 by 0.5 m");
  EXPECT_EQ(difference([](Hand& h) { h.run.mass[7] = 9.0; }),
            "masses differ at node 7: 8 kg/m against 9");
  EXPECT_EQ(difference([](Hand& h) { std::swap(h.run.mesh.sector[0], h.run.mesh.sector[3]); }),
            "the numbering of the sectors differs");
}

}  // namespace
}  // namespace rondo::io::test::run_reader_test
