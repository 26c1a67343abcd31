// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/xdmf.hpp"

#include "unit/io/support.hpp"

namespace rondo::io::test::xdmf_test {
namespace {

XdmfSeries series() {
  XdmfSeries s;
  s.data_file = "results.h5";
  s.topology = {"Quadrilateral", 7, "/mesh/cells", {7, 4}};
  s.reference = "/mesh/coordinates";
  s.position = "/fields/position";
  s.n_nodes = 11;
  s.n_times = 5;
  s.fields = {{"speed", "Scalar", "/fields/speed"},
              {"stress", "Tensor6", "/fields/stress", 6, 0, 6},
              {"stress_yy", "Scalar", "/fields/stress", 6, 3, 1}};
  return s;
}

TEST(Xdmf, IsValidAfterEveryGrid) {
  const Folder folder;
  Xdmf xdmf(folder / "fields.xdmf", series());
  EXPECT_TRUE(is_well_formed(text_of(folder / "fields.xdmf")));
  EXPECT_NE(text_of(folder / "fields.xdmf").find("/mesh/coordinates"), std::string::npos);
  for (int k = 0; k < 5; ++k) {
    xdmf.add(0.1 * k);
    const std::string text = text_of(folder / "fields.xdmf");
    EXPECT_TRUE(is_well_formed(text)) << text;
    EXPECT_EQ(text.find("/mesh/coordinates"), std::string::npos);
    EXPECT_NE(text.find("<Time Value=\"" + std::string(k == 0 ? "0" : "0.1") + "\"/>"),
              std::string::npos);
  }
  EXPECT_EQ(xdmf.size(), 5U);
}

std::size_t n_grids(const std::string& text) {
  std::size_t n = 0;
  for (auto at = text.find("<Time"); at != std::string::npos; at = text.find("<Time", at + 1)) ++n;
  return n;
}

/// A process that is killed leaves the file that was there last, with most of the grids.
TEST(Xdmf, ALongSeriesIsListedInPartsAndInWholeAtTheEnd) {
  const Folder folder;
  const auto file = folder / "fields.xdmf";
  {
    Xdmf xdmf(file, series());
    std::size_t written = 0;
    for (std::size_t k = 1; k <= 200; ++k) {
      xdmf.add(static_cast<double>(k));
      const std::size_t listed = n_grids(text_of(file));
      ASSERT_LE(k - listed, k / 16) << k;
      written += listed == k ? 1 : 0;
    }
    EXPECT_LT(written, 60U);
  }
  EXPECT_EQ(n_grids(text_of(file)), 200U);
  EXPECT_TRUE(is_well_formed(text_of(file)));
  Xdmf closed(file, series());
  closed.add(0.0);
  closed.close();
  EXPECT_EQ(n_grids(text_of(file)), 1U);
}

TEST(Xdmf, SlabsNameTimesNodesAndComponents) {
  const Folder folder;
  Xdmf xdmf(folder / "fields.xdmf", series());
  xdmf.add(0.0);
  xdmf.add(1.0);
  const std::string text = text_of(folder / "fields.xdmf");
  for (const char* slab : {"results.h5:/fields/position|1 0 0:1 1 1:1 11 3:5 11 3<",
                           "results.h5:/fields/speed|1 0:1 1:1 11:5 11<",
                           "results.h5:/fields/stress|1 0 0:1 1 1:1 11 6:5 11 6<",
                           "results.h5:/fields/stress|1 0 3:1 1 1:1 11 1:5 11 6<",
                           ">1 0 3 1 1 1 1 11 1<", ">1 0 1 1 1 11<"})
    EXPECT_NE(text.find(slab), std::string::npos) << slab;
}

TEST(Xdmf, ClosedEarlyNamesTheShorterDatasets) {
  const Folder folder;
  Xdmf xdmf(folder / "fields.xdmf", series());
  xdmf.add(0.0);
  xdmf.add(1.0);
  xdmf.close();
  const std::string text = text_of(folder / "fields.xdmf");
  EXPECT_TRUE(is_well_formed(text));
  EXPECT_NE(text.find("Dimensions=\"2 11 3\""), std::string::npos);
  EXPECT_EQ(text.find("Dimensions=\"5 11 3\""), std::string::npos);
}

TEST(Xdmf, WithoutPositionsEachGridShowsTheReference) {
  const Folder folder;
  XdmfSeries fixed = series();
  fixed.position.clear();
  Xdmf xdmf(folder / "fields.xdmf", fixed);
  for (const double time : {1.0, 2.0}) xdmf.add(time);
  const std::string text = text_of(folder / "fields.xdmf");
  EXPECT_TRUE(is_well_formed(text));
  const std::string reference = "Dimensions=\"11 2\">results.h5:/mesh/coordinates<";
  const auto first = text.find(reference);
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(text.find(reference, first + 1), std::string::npos);
  EXPECT_EQ(text.find("GeometryType=\"XYZ\""), std::string::npos);
  EXPECT_NE(text.find("results.h5:/fields/speed|1 0:"), std::string::npos);
}

TEST(Xdmf, ErrorsNameTheFileAndTheReason) {
  const Folder folder;
  const std::string none =
      error_of<FileError>([&] { const Xdmf xdmf(folder / "no/fields.xdmf", series()); });
  EXPECT_NE(none.find("no/fields.xdmf: cannot create: No such file"), std::string::npos) << none;
  const int status = in_child([&] {
    Xdmf xdmf(folder / "fields.xdmf", series());
    limit_files(1000);
    const std::string full = error_of<FileError>([&] { xdmf.add(0.0); });
    EXPECT_NE(full.find("fields.xdmf: cannot write: File too large"), std::string::npos) << full;
    if (::testing::Test::HasFailure()) std::_Exit(1);
  });
  EXPECT_TRUE(went_well(status));
}

}  // namespace
}  // namespace rondo::io::test::xdmf_test
