// SPDX-License-Identifier: BSD-3-Clause
/// @file  fields.vtkhdf as h5 reads it; its layout is checked by tests/cli/test_vtkhdf.py.
#include "rondo/io/vtkhdf.hpp"

#include <cstdint>

#include "unit/io/support.hpp"

namespace rondo::io::test::vtkhdf_test {
namespace {

using Whole = std::vector<std::int64_t>;

XdmfSeries series() {
  XdmfSeries s;
  s.data_file = "data.h5";
  s.topology = {"Triangle", 1, "/mesh/cells", {1, 3}, 3};
  s.position = "/position";
  s.n_nodes = 3;
  s.n_times = 4;
  s.fields = {{"stress", "Tensor6", "/stress", 6, 0, 6},
              {"stress_yy", "Scalar", "/stress", 6, 3, 1}};
  return s;
}

/// Number k of node i at time t is 100 t + 10 i + k.
void write_data(const Folder& folder) {
  h5::File file = h5::File::create(folder / "data.h5");
  mesh::Mesh mesh;
  mesh.cells = {{0, 1, 2, -1}};
  write_vtk_cells(file, mesh);
  for (const auto& [name, width] : {std::pair("/position", 3), std::pair("/stress", 6)}) {
    std::vector<float> values;
    for (int t = 0; t < 4; ++t)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < width; ++k) values.push_back(static_cast<float>(100 * t + 10 * i + k));
    file.write(name, {4, 3, static_cast<std::size_t>(width)}, values, {"1", "test"});
  }
  file.close();
}

TEST(Vtkhdf, AStepForEachRowAdded) {
  const Folder folder;
  write_data(folder);
  Vtkhdf vtk(folder / "fields.vtkhdf", series());
  EXPECT_FALSE(std::filesystem::exists(folder / "fields.vtkhdf"));
  for (std::size_t t = 1; t <= 3; ++t) {
    vtk.add(0.5 * static_cast<double>(t));
    vtk.sync();
    const h5::File file = h5::File::open(folder / "fields.vtkhdf");
    EXPECT_EQ(file.read<double>("/VTKHDF/Steps/Values").size(), t);
    EXPECT_EQ(file.read<double>("/VTKHDF/Steps/Values").back(), 0.5 * static_cast<double>(t));
    EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/Steps/NumberOfParts"), Whole(t, 1));
    EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/Steps/PointDataOffsets/stress").back(),
              static_cast<std::int64_t>(3 * (t - 1)));
    EXPECT_EQ(file.dataset("/VTKHDF/Steps/CellOffsets").shape(), (h5::Shape{t, 1}));
  }
}

TEST(Vtkhdf, ManyRowsInAShortTimeMakeFewFiles) {
  const Folder folder;
  write_data(folder);
  Vtkhdf vtk(folder / "fields.vtkhdf", series());
  const auto steps = [&] {
    return h5::File::open(folder / "fields.vtkhdf").read<double>("/VTKHDF/Steps/Values").size();
  };
  const auto begin = std::chrono::steady_clock::now();
  vtk.add(0.0);
  EXPECT_EQ(steps(), 1U);
  vtk.add(1.0);
  if (std::chrono::steady_clock::now() - begin < Vtkhdf::interval) {
    EXPECT_EQ(steps(), 1U);
  }
  std::this_thread::sleep_for(Vtkhdf::interval);
  vtk.add(2.0);
  EXPECT_EQ(steps(), 3U);
  vtk.add(3.0);
  vtk.close();
  EXPECT_EQ(steps(), 4U);
}

TEST(Vtkhdf, ShowsWhatTheOtherFileHolds) {
  const Folder folder;
  write_data(folder);
  Vtkhdf vtk(folder / "fields.vtkhdf", series(), {0.0, 1.0, 2.0});
  vtk.close();
  const h5::File file = h5::File::open(folder / "fields.vtkhdf");
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/Connectivity"), (Whole{0, 1, 2}));
  EXPECT_EQ(file.dataset("/VTKHDF/Points").shape(), (h5::Shape{9, 3}));
  EXPECT_EQ(row_of<float>(file.dataset("/VTKHDF/Points"), 5),
            (std::vector<float>{120.0F, 121.0F, 122.0F}));
  // Of xx, xy, xz, yy, yz, zz: xx, yy, zz, xy, yz, xz.
  EXPECT_EQ(row_of<float>(file.dataset("/VTKHDF/PointData/stress"), 7),
            (std::vector<float>{210.0F, 213.0F, 215.0F, 211.0F, 214.0F, 212.0F}));
  EXPECT_EQ(row_of<float>(file.dataset("/VTKHDF/PointData/stress_yy"), 7),
            (std::vector<float>{213.0F}));
}

TEST(Vtkhdf, ItsBytesDependOnTheStepsAlone) {
  const Folder folder;
  for (const char* name : {"one", "all"}) {
    const bool at_once = std::string(name) == "all";
    Vtkhdf vtk(folder / name, series(), at_once ? std::vector{0.0, 1.0} : std::vector<double>{});
    if (!at_once)
      for (const double time : {0.0, 1.0}) vtk.add(time);
    vtk.close();
  }
  EXPECT_EQ(text_of(folder / "one"), text_of(folder / "all"));
}

TEST(Vtkhdf, ErrorsNameTheFile) {
  const Folder folder;
  const std::string none =
      error_of<FileError>([&] { const Vtkhdf vtk(folder / "no/fields.vtkhdf", series(), {0.0}); });
  EXPECT_NE(none.find("no/fields.vtkhdf: cannot create: No such file"), std::string::npos) << none;
}

}  // namespace
}  // namespace rondo::io::test::vtkhdf_test
